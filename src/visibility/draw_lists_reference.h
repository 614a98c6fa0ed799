// Plain CPU twin of the kernels that build draw lists: bin_objects, scan, scatter and write_commands.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "visibility/submission.h"

namespace jalousie::visibility {

/// What one list draws.
struct DrawLists {
  std::vector<gpu::uint> instances;  ///< object ids with kInstance... bits, bin after bin
  std::array<std::vector<gpu::DrawCommand>, gpu::kListCount> commands;  ///< without the empty ones of kInstanced
  std::uint32_t dropped = 0;                                            ///< instances beyond the capacity
};

/// @param states, boxes, marks  [scene.objects.size()]   @param phase  kMarkEarly or kMarkLate
/// @param capacity  most instances the list holds; the first ones stay
DrawLists buildDrawLists(const scene::SceneData& scene, const gpu::CullView& view,
                         std::span<const gpu::ObjectState> states, std::span<const gpu::ScreenBox> boxes,
                         std::span<const gpu::uint> marks, gpu::uint phase, Submission submission,
                         std::uint32_t capacity);

}  // namespace jalousie::visibility
