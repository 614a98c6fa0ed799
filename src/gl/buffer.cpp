// Buffer storage and transfers through direct state access.
#include "gl/buffer.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/check.h"
#include "gl/memory.h"

namespace jalousie::gl {

Buffer::Buffer(std::size_t sizeBytes, GLbitfield flags, const char* name, const void* data)
    : sizeBytes_(std::max<std::size_t>(sizeBytes, 16)) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  handle_ = Handle<BufferTraits>(id);
  label(GL_BUFFER, id, name);
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(sizeBytes_), sizeBytes == sizeBytes_ ? data : nullptr, flags);
  requireMemory(fmt::format("buffer '{}' of {} MiB", name, sizeBytes_ >> 20U));
  if (data != nullptr && sizeBytes != sizeBytes_ && sizeBytes > 0)
    write(0, std::span(static_cast<const std::byte*>(data), sizeBytes));
}

void Buffer::write(std::size_t offsetBytes, std::span<const std::byte> bytes) {
  JAL_CHECK(offsetBytes <= sizeBytes_);
  JAL_CHECK(bytes.size() <= sizeBytes_ - offsetBytes);
  glNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::readBytes(std::size_t offsetBytes, std::span<std::byte> target) const {
  JAL_CHECK(offsetBytes <= sizeBytes_);
  JAL_CHECK(target.size() <= sizeBytes_ - offsetBytes);
  if (target.empty()) return;
  glGetNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes), static_cast<GLsizeiptr>(target.size()),
                          target.data());
}

void Buffer::clear() {
  const GLuint zero = 0;
  glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

}  // namespace jalousie::gl
