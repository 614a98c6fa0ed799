// What one frame did, counted from the kernels' verdicts after the frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene_data.h"
#include "shared/frame_structs.h"

namespace jalousie::render {

struct FrameStatistics {
  std::uint64_t objects = 0;
  std::uint64_t culledFrustum = 0;
  std::uint64_t occluders = 0;
  std::uint64_t culledOcclusion = 0;
  std::uint64_t drawn = 0;
  std::uint64_t triangles = 0;      ///< sent to the final draw
  std::uint64_t trianglesFull = 0;  ///< all objects at their finest
  /// Drawn objects per level: LOD 0, 1, ... of the discrete chains, or tessellation level 1, 2, ... of the patch path.
  std::vector<std::uint64_t> lodHistogram;
};

/// Counts states against the scene. @param states  gpu::ObjectState [scene.objects.size()]
FrameStatistics countFrame(const scene::SceneData& scene, const gpu::CullView& view,
                           std::span<const gpu::ObjectState> states);

}  // namespace jalousie::render
