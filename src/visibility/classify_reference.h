// Plain CPU twin of shaders/visibility/classify.comp: frustum test, screen rectangle, occluder selection.
#pragma once

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "scene/scene_data.h"
#include "shared/frame_structs.h"

namespace jalousie::visibility {

/// Where a box lies on the screen.
struct BoxOnScreen {
  bool outside = false;      ///< every corner lies beyond one plane of the clip volume
  bool crossesNear = false;  ///< some corner has w <= 0: no finite rectangle
  gpu::ScreenRect rect{};    ///< pixels, clipped to the viewport; valid unless outside or crossesNear
  Aabb boundsWorld;          ///< axis-aligned box of the transformed corners
};

/// @param boundsObject   box in the object's frame
/// @param clipFromWorld  reversed depth: inside is |x|, |y| <= w, 0 <= z <= w
/// @param viewport       width and height in pixels
BoxOnScreen boxOnScreen(const glm::mat4& worldFromObject, const Aabb& boundsObject, const glm::mat4& clipFromWorld,
                        const glm::vec2& viewport);

/// Distance from a point to the closest point of a box, world units; 0 inside.
float distanceToBox(const glm::vec3& point, const Aabb& box);

/// Verdict of one box before the overlap test: kVerdictOutside, kVerdictOccluder, kVerdictNear or kVerdictPending.
gpu::uint classify(const BoxOnScreen& box, const gpu::CullView& view);

}  // namespace jalousie::visibility
