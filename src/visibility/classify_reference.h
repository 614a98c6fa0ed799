// Plain CPU twin of shaders/visibility/classify.comp: frustum test, screen box, occluder selection, first detail.
#pragma once

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "visibility/importance_mask.h"
#include "visibility/object_decision.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// Where a box lies on the screen. Everything is rounded outwards (docs/two_phase_culling.md).
struct BoxOnScreen {
  bool outside = false;      ///< every corner lies beyond one plane of the clip volume
  bool crossesNear = false;  ///< some corner is not safely beyond the near plane: no finite rectangle
  glm::vec4 rect{0.0F};      ///< min.xy, max.xy in pixels, clipped to the viewport; valid unless outside or crossesNear
  float nearestDepth = 0.0F;  ///< upper bound of the window depth of any point; valid unless crossesNear
  Aabb boundsWorld;           ///< axis-aligned box of the transformed corners
};

/// @param boundsObject   box in the object's frame
/// @param clipFromWorld  reversed depth: inside is |x|, |y| <= w, 0 <= z <= w
/// @param viewport       width and height in pixels
/// @param rounding       share of the magnitudes by which a clip-space component may be off; the kernel's is kRounding
BoxOnScreen boxOnScreen(const gpu::Transform& transform, const Aabb& boundsObject, const glm::mat4& clipFromWorld,
                        const glm::vec2& viewport, float rounding = gpu::kRounding);

/// Distance from a point to the closest point of a box, world units; 0 inside.
float distanceToBox(const glm::vec3& point, const Aabb& box);

/// Distance from the eye of a view to the closest point of a box, world units; 0 inside. For an orthographic view, from
/// the plane of its camera along its direction; 0 behind that plane.
float distanceFromEye(const gpu::CullView& view, const Aabb& box);

/// Area of the sphere around a world box on the screen, pixels: that of an ellipse, pi f^2 r^2 sqrt(D^2 - r^2) /
/// (d^2 - r^2)^(3/2) with D the distance of the centre and d its depth; infinite where the sphere reaches the plane of
/// the eye (d <= r). Orthographic: pi f^2 r^2.
float sphereArea(const gpu::CullView& view, const Aabb& box);

/// Upper bound of how much a transform stretches a length; exact where the axes stay orthogonal.
float largestScale(const gpu::Transform& transform);

/// Whether the transform has a negative determinant.
bool isMirrored(const gpu::Transform& transform);

/// Verdict of one box before the overlap test. @param importance  in (0, 1]; scales the pixels it counts for
gpu::uint classify(const BoxOnScreen& box, const gpu::CullView& view, float importance = 1.0F);

/// Two phases: whether an object is drawn before the test. An object that was tested in the last frame is expected to
/// keep its visibility; of the others, those with a large rectangle (kLargeShare) are expected to be visible.
/// @param rect  pixels, clipped
bool isExpectedVisible(gpu::uint lastMarks, const glm::vec4& rect, const gpu::CullView& view);

/// Flags (kMark...) that the verdict alone decides. @param traits  gpu::CullView::traits
gpu::uint phasesOf(gpu::uint verdict, bool expectedVisible, gpu::uint traits);

/// What the last frame left of one object.
struct LastFrame {
  gpu::ObjectState state{};
  gpu::uint marks = 0;
  gpu::uint pixels = 0;               ///< visible ones, when they were last counted
  gpu::PriceState price{};            ///< of all objects, after that frame
  gpu::uint cover = gpu::kCoverOpen;  ///< as gpu::ScreenBox
};

/// What the kernel writes for one object. @param importance  null: no mask
ObjectDecision classifyObject(const scene::SceneData& scene, const gpu::CullView& view, gpu::uint objectIndex,
                              const LastFrame& last, const ImportanceMask* importance = nullptr);

}  // namespace jalousie::visibility
