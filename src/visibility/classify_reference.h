// Plain CPU twin of shaders/visibility/classify.comp: frustum test, screen box, occluder selection, first detail.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "core/aabb.h"
#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "visibility/importance_mask.h"

namespace jalousie::visibility {

/// Where a box lies on the screen. Everything is rounded outwards (docs/two_phase_culling.md).
struct BoxOnScreen {
  bool outside = false;      ///< every corner lies beyond one plane of the clip volume
  bool crossesNear = false;  ///< some corner is not safely beyond the near plane: no finite rectangle
  glm::vec4 rect{0.0F};      ///< min.xy, max.xy in pixels, clipped to the viewport; valid unless outside or crossesNear
  float nearestDepth = 0.0F;    ///< upper bound of the window depth of any point; valid unless crossesNear
  Aabb boundsWorld;             ///< axis-aligned box of the transformed corners
  glm::vec3 centerWorld{0.0F};  ///< bounding sphere
  float radiusWorld = 0.0F;
};

/// @param boundsObject   box in the object's frame
/// @param clipFromWorld  reversed depth: inside is |x|, |y| <= w, 0 <= z <= w
/// @param viewport       width and height in pixels
BoxOnScreen boxOnScreen(const gpu::Transform& transform, const Aabb& boundsObject, const glm::mat4& clipFromWorld,
                        const glm::vec2& viewport);

/// Distance from a point to the closest point of a box, world units; 0 inside.
float distanceToBox(const glm::vec3& point, const Aabb& box);

/// Upper bound of how much a transform stretches a length; exact where the axes stay orthogonal.
float largestScale(const gpu::Transform& transform);

/// Whether the transform has a negative determinant.
bool isMirrored(const gpu::Transform& transform);

/// Verdict of one box before the overlap test. @param importance  in (0, 1]; scales the pixels it counts for
gpu::uint classify(const BoxOnScreen& box, const gpu::CullView& view, float importance = 1.0F);

/// Two phases: whether an object is drawn before the test. What was tested in the last frame is expected to stay as it
/// was; of what is new, the large ones (kLargeShare). @param rect  pixels, clipped
bool isExpectedVisible(gpu::uint lastMarks, const glm::vec4& rect, const gpu::CullView& view);

/// kMark... that the verdict alone decides. @param traits  gpu::CullView::traits
gpu::uint phasesOf(gpu::uint verdict, bool expectedVisible, gpu::uint traits);

/// What the kernel writes for one object.
struct Classified {
  gpu::ObjectState state{};
  gpu::ScreenBox box{};
  gpu::uint marks = 0;
};

/// What is left of one object from the last frame.
struct LastFrame {
  gpu::ObjectState state{};
  gpu::uint marks = 0;
  gpu::uint pixels = 0;  ///< that showed the object
};

/// @param importance  null: no mask
Classified classifyObject(const scene::SceneData& scene, const gpu::CullView& view, gpu::uint objectIndex,
                          const LastFrame& last, const ImportanceMask* importance = nullptr);

}  // namespace jalousie::visibility
