// Vertex array objects.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/handle.h"

namespace jalousie::gl {

/// One attribute inside a vertex.
struct AttributeFormat {
  GLuint location;
  GLint components;
  GLenum type;
  bool normalized;  ///< integers become [0, 1] or [-1, 1]
  bool integer;     ///< integers stay integers in the shader
  std::uint32_t offsetBytes;
};

/// Vertex input state: buffers and formats of the attributes.
class VertexArray {
 public:
  VertexArray() = default;
  /// glCreateVertexArrays.
  explicit VertexArray(const char* name);

  GLuint id() const { return handle_.id(); }
  /// glVertexArrayVertexBuffer, glVertexArrayBindingDivisor. @param divisor  0 per vertex, 1 per instance
  void setBuffer(GLuint binding, const Buffer& buffer, std::uint32_t strideBytes, GLuint divisor);
  /// glVertexArrayAttribFormat / IFormat, glVertexArrayAttribBinding.
  void setAttribute(GLuint binding, const AttributeFormat& format);
  /// glVertexArrayElementBuffer.
  void setIndexBuffer(const Buffer& buffer);
  /// glBindVertexArray.
  void bind() const { glBindVertexArray(id()); }

 private:
  Handle<VertexArrayTraits> handle_;
};

}  // namespace jalousie::gl
