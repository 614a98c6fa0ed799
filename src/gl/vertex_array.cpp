// Vertex input state through direct state access.
#include "gl/vertex_array.h"

namespace jalousie::gl {

VertexArray::VertexArray(const char* name) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  handle_ = Handle<VertexArrayTraits>(id);
  label(GL_VERTEX_ARRAY, id, name);
}

void VertexArray::setBuffer(GLuint binding, const Buffer& buffer, std::uint32_t strideBytes, GLuint divisor) {
  glVertexArrayVertexBuffer(id(), binding, buffer.id(), 0, static_cast<GLsizei>(strideBytes));
  glVertexArrayBindingDivisor(id(), binding, divisor);
}

void VertexArray::setAttribute(GLuint binding, const AttributeFormat& format) {
  glEnableVertexArrayAttrib(id(), format.location);
  if (format.integer) {
    glVertexArrayAttribIFormat(id(), format.location, format.components, format.type, format.offsetBytes);
  } else {
    glVertexArrayAttribFormat(id(), format.location, format.components, format.type,
                              format.normalized ? GL_TRUE : GL_FALSE, format.offsetBytes);
  }
  glVertexArrayAttribBinding(id(), format.location, binding);
}

void VertexArray::setIndexBuffer(const Buffer& buffer) {
  glVertexArrayElementBuffer(id(), buffer.id());
}

}  // namespace jalousie::gl
