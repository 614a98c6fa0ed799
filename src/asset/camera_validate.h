// The range of the numbers that a glTF camera may have.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>

namespace jalousie::asset::detail {

/// Checks the lens of a camera, in the precision that it is used in: 0 < yfov < pi (radians), znear > 0, zfar beyond
/// znear or absent, aspectRatio not negative; for orthographic cameras xmag and ymag other than 0, znear not negative,
/// zfar beyond znear. All of them must be finite as floats. @param index  of the camera, for the message.
/// Errors: kMalformed.
void validateLens(const tinygltf::Camera& camera, std::size_t index);

}  // namespace jalousie::asset::detail
