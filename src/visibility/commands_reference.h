// Plain CPU twin of shaders/visibility/emit_commands.comp: detail per object and its draw commands.
#pragma once

#include <array>
#include <vector>

#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"

namespace jalousie::visibility {

/// Whether a verdict is drawn.
inline bool isDrawn(gpu::uint verdict) {
  return verdict != gpu::kVerdictOutside && verdict != gpu::kVerdictOccluded;
}

/// Fills lod and tessellation from verdict and lv under the view's rule.
gpu::ObjectState chooseDetail(gpu::ObjectState state, const gpu::CullView& view, const gpu::Chain& chain);

/// One object's command in each draw list; lists the detail path does not use stay zero.
std::array<gpu::DrawCommand, gpu::kListCount> objectCommands(const scene::SceneData& scene, const gpu::CullView& view,
                                                             gpu::uint objectIndex, bool drawn, gpu::uint lod,
                                                             gpu::uint tessellation);

}  // namespace jalousie::visibility
