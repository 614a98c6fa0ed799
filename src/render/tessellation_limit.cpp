// The limit as a count of vertices: a triangle at level n has (n + 1)(n + 2) / 2 of them.
#include "render/tessellation_limit.h"

#include <algorithm>

#include "shared/limits.h"

namespace jalousie::render {

gpu::uint tessellationLimit(const gl::Capabilities& capabilities, std::uint32_t patchTriangles) {
  if (!capabilities.softwareRenderer) return gpu::kMaxTessellationLevel;
  constexpr std::uint32_t kPatchesAtOnce = 341;
  constexpr std::uint32_t kVerticesAtOnce = 45000;
  const std::uint32_t patches = std::clamp(patchTriangles, 1U, kPatchesAtOnce);
  gpu::uint level = gpu::kMaxTessellationLevel;
  while (level > 1 && patches * (level + 1) * (level + 2) / 2 > kVerticesAtOnce)
    --level;
  return level;
}

}  // namespace jalousie::render
