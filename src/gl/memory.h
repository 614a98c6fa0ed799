// Whether the driver had room for what was just allocated.
#pragma once

#include <string>

namespace jalousie::gl {

/// Call it after glNamedBufferStorage or glTextureStorage. Reads glGetError, so it may wait for the driver's thread.
/// @param what  "texture 'frame colour' of 1280x720 texels"   Errors: kLimit if the allocation failed.
void requireMemory(const std::string& what);

}  // namespace jalousie::gl
