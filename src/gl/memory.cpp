// Turns GL_OUT_OF_MEMORY into a failure that names what was too large.
#include "gl/memory.h"

#include <epoxy/gl.h>

#include "core/error.h"

namespace jalousie::gl {

void requireMemory(const std::string& what) {
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
    if (error == GL_OUT_OF_MEMORY) throw Error(ErrorCode::kLimit, "the driver has no memory for a " + what);
}

}  // namespace jalousie::gl
