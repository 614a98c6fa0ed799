// Buffers with immutable storage.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "gl/handle.h"

namespace jalousie::gl {

/// A buffer with a fixed size in bytes. Move-only; a moved-from buffer has id 0 and size 0.
class Buffer {
 public:
  Buffer() = default;
  /// glCreateBuffers, glNamedBufferStorage. A size below 16 is raised to 16 so that every buffer can be bound.
  /// @param flags  GL_DYNAMIC_STORAGE_BIT to allow write(); 0 for data that only the GPU writes
  /// @param data   [sizeBytes] initial content; null: undefined
  Buffer(std::size_t sizeBytes, GLbitfield flags, const char* name, const void* data = nullptr);

  /// Static storage filled from an array of trivially copyable elements.
  template <class T>
  static Buffer fromArray(std::span<const T> elements, const char* name) {
    static_assert(std::is_trivially_copyable_v<T>);
    return Buffer(elements.size_bytes(), GL_DYNAMIC_STORAGE_BIT, name, elements.empty() ? nullptr : elements.data());
  }

  GLuint id() const { return handle_.id(); }
  std::size_t sizeBytes() const { return sizeBytes_; }

  /// glNamedBufferSubData. @pre offset + size fit (checked), storage made with GL_DYNAMIC_STORAGE_BIT
  void write(std::size_t offsetBytes, std::span<const std::byte> bytes);
  template <class T>
  void writeValue(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    write(0, std::as_bytes(std::span(&value, 1)));
  }

  /// glGetNamedBufferSubData: waits for the GPU, so never call it during a frame.
  template <class T>
  std::vector<T> read(std::size_t count, std::size_t offsetBytes = 0) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> result(count);
    readBytes(offsetBytes, std::as_writable_bytes(std::span(result)));
    return result;
  }

  /// The same into an array of the caller.
  template <class T>
  void readInto(std::span<T> target) const {
    static_assert(std::is_trivially_copyable_v<T>);
    readBytes(0, std::as_writable_bytes(target));
  }

  /// glClearNamedBufferData with zeros.
  void clear();

  /// glBindBufferBase.
  void bindStorage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id()); }
  /// glBindBufferRange of a storage block. @pre offset is a multiple of GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT
  void bindStorageRange(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, id(), static_cast<GLintptr>(offsetBytes),
                      static_cast<GLsizeiptr>(bytes));
  }
  void bindUniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, id()); }
  /// glBindBufferRange of a uniform block. @pre offset is a multiple of GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT
  void bindUniformRange(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, id(), static_cast<GLintptr>(offsetBytes),
                      static_cast<GLsizeiptr>(bytes));
  }

 private:
  void readBytes(std::size_t offsetBytes, std::span<std::byte> target) const;

  Handle<BufferTraits> handle_;
  std::size_t sizeBytes_ = 0;
};

}  // namespace jalousie::gl
