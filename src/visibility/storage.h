// Buffers that the kernels index by object, level or entry.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gl/buffer.h"

namespace jalousie::visibility {

/// Refuses a buffer that a kernel could not address. Errors: kLimit with the name, the size and the driver's limit.
void checkStorage(std::size_t bytes, const char* name);

/// What kernels read. Errors: kLimit, as checkStorage.
template <class T>
gl::Buffer uploadStorage(const std::vector<T>& elements, const char* name) {
  checkStorage(elements.size() * sizeof(T), name);
  return gl::Buffer::fromArray(std::span<const T>(elements), name);
}

/// A storage buffer of zeros. @param flags  as gl::Buffer   Errors: kLimit, as checkStorage.
gl::Buffer makeStorage(std::size_t bytes, GLbitfield flags, const char* name);

}  // namespace jalousie::visibility
