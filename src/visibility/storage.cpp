// Storage buffers within the driver's limit.
#include "visibility/storage.h"

#include <string>

#include "core/error.h"

namespace jalousie::visibility {

void checkStorage(std::size_t bytes, const char* name) {
  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  if (bytes > static_cast<std::size_t>(largest))
    throw Error(ErrorCode::kLimit, std::string("the ") + name + " need " + std::to_string(bytes >> 20U) +
                                       " MiB in one buffer, this driver allows " + std::to_string(largest >> 20U) +
                                       " MiB");
}

gl::Buffer makeStorage(std::size_t bytes, GLbitfield flags, const char* name) {
  checkStorage(bytes, name);
  gl::Buffer buffer(bytes, flags, name);
  buffer.clear();
  return buffer;
}

}  // namespace jalousie::visibility
