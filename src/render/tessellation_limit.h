// How fine the driver may tessellate a mesh without losing triangles.
#pragma once

#include <cstdint>

#include "gl/capabilities.h"
#include "shared/types.h"

namespace jalousie::render {

/// Finest level at which the driver draws every patch of a mesh. A GPU has no limit here. Mesa's software rasterisers
/// (measured: llvmpipe of Mesa 22.3) tessellate up to 341 patches of one draw together and silently drop what exceeds
/// about 45,900 vertices: a mesh of 98 patches is whole at level 20, one of 341 or more only up to level 14.
/// @param patchTriangles  triangles of the largest base mesh   @return  1..kMaxTessellationLevel
gpu::uint tessellationLimit(const gl::Capabilities& capabilities, std::uint32_t patchTriangles);

}  // namespace jalousie::render
