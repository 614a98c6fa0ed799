// Names for the figures that the GPU counts.
#pragma once

#include "render/frame_statistics.h"
#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "visibility/frame_counters.h"

namespace jalousie::render {

/// Triangles of all objects at their finest, on both detail paths. Counted once per scene.
struct FinestTriangles {
  std::uint64_t discrete = 0;
  std::uint64_t patchBase = 0;  ///< before tessellation
  std::uint32_t maxLods = 0;    ///< longest chain
};
FinestTriangles countFinestTriangles(const scene::SceneData& scene);

/// Figures by name.
FrameStatistics makeStatistics(const visibility::FrameCounters& counters, const gpu::CullView& view,
                               const FinestTriangles& full);

}  // namespace jalousie::render
