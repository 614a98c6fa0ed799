// From a level of visibility (thesis 4.1.3) or a size on screen to a level of detail. GPU twin: shaders/lib/lod.glsl
#pragma once

#include <cstdint>
#include <span>

#include "shared/frame_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// Occluded share in [0, 1]: (clamp(lv, -1, 1) + 1) / 2; 0 fully visible, 1 fully occluded.
/// @param lv  normalised level of visibility; can be below -1
float hiddenShare(float lv);

/// floor(mix(levels, 1, hiddenShare)), in [1, levels]. LV = 641/1024 with 20 levels gives 4.
std::uint32_t tessellationLevel(float lv, std::uint32_t levels);

/// The same mapping onto a chain: 0 for a fully visible object, lodCount - 1 for an occluded one. @pre lodCount >= 1
std::uint32_t linearLod(float lv, std::uint32_t lodCount);

/// 1 - hiddenShare(lv), at least kLeastShare.
float visibleShare(float lv);

/// Factor by which the budget of a partly occluded object grows: visibleShare(lv)^(-1/4), at most 1 + relax
/// (docs/lod_selection.md).
float relaxedBudget(float lv, float relax);

/// LV of an object with `visible` visible pixels and a bounding rectangle of `area` pixels: 1 - 2 s with the visible
/// share s = min((visible + kPixelGuard) / (kSilhouetteShare * area + kPixelGuard), 1).
float pixelsLv(float visible, float area);

/// Visible pixels of an object with a level of visibility, the inverse of pixelsLv: at most the share of the rectangle
/// that an object in full sight is taken to fill. @param area  of the bounding rectangle, pixels
float visiblePixels(float lv, float area);

/// LV smoothed over time: one step from the last frame's value towards the measured one. The step is larger when the
/// object becomes visible (kSmoothAppearing) than when it becomes occluded (kSmoothHiding).
float smoothLv(float last, float measured);
/// LV of an object out of view, which cannot be measured: one step from the last frame's value towards fully visible.
float forgottenLv(float last);

/// Pixels that an error of one object-space unit can cover: scale * focalPixels / max(distance, zNear).
/// @param scale  world units per object unit   @param distance  from the eye to the nearest point of the world box
float projectedScale(float scale, float focalPixels, float distance, float zNear);

/// Coarsest level with errorObject * pixelsPerUnit <= tau; 0 if none. A level of unknown (infinite) error never
/// qualifies.
std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau);

/// Share of a screen's area that the bounding sphere of a box covers, at the distance of pixelsPerUnit; not clipped.
/// @param screenPixels  of the screen, width times height
float sphereCoverage(const glm::vec3& sizeObject, float pixelsPerUnit, float screenPixels);
/// Finest level with coverage >= leastCoverage; the coarsest where there is none, so that no object is lost. 0 where
/// the coverage is not a number.
std::uint32_t coverageLod(std::span<const gpu::Lod> levels, float coverage);

/// Level between the ones that tau and tau * relaxed allow, with the least share * (error / tau)^2 + triangles /
/// (triangles at tau). A coarser level that saves few triangles is not worth its error. @param share  visible, (0, 1]
std::uint32_t relaxedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau, float relaxed, float share);

/// What the error and the triangles of one object cost (docs/lod_selection.md).
struct Price {
  float pixels = 0.0F;       ///< of the object, visible
  float perTriangle = 0.0F;  ///< pixels of area times pixels of error
  float maxError = 0.0F;     ///< limit of the largest deviation, pixels; may be infinite
};

/// Level with the least (pixels + 1) * min(mean error, kErrorCap) + perTriangle * triangles, the finer one of equals.
/// Levels beyond the limit of the largest deviation and those of unknown error do not count; LOD 0 always does.
std::uint32_t pricedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, const Price& price);

/// The same over the tessellation levels n of a patch base, whose error falls with n^2; in [1, maxLevel]. The finest
/// where all are beyond the limit.
/// @param errorPixels  of the untessellated base   @param triangles  of the base   @pre maxLevel >= 1
std::uint32_t pricedTessellation(float errorPixels, float triangles, const Price& price, std::uint32_t maxLevel);

/// Lowest level in [1, maxLevel] whose triangles stay within tau of the curved surface: errorPixels / level^2 <= tau.
/// @param errorPixels  projected gap between the untessellated base and its curved surface
std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel);

/// Frames that a cross-fade still takes, this one included; 0: none.
std::uint32_t fadeFrames(gpu::uint marks);
/// The level that fades out. @pre fadeFrames(marks) > 0
std::uint32_t fadingLod(std::uint32_t lod, gpu::uint marks);

/// One step from the last level towards [lowest, highest].
std::uint32_t stepTowards(std::uint32_t last, std::uint32_t lowest, std::uint32_t highest);

/// What the choice of detail needs to know of an object besides the view.
struct DetailInput {
  std::span<const gpu::Lod> levels;  ///< of the chain, LOD 0 first
  gpu::Lod patches{};                ///< the patch base
  float pixelsPerUnit = 0.0F;        ///< as gpu::ScreenBox
  float tau = 0.0F;                  ///< as gpu::ScreenBox
  float area = 0.0F;  ///< of the bounding rectangle, pixels; of the screen across the near plane; 0 out of view
  float surfaceObject = 0.0F;         ///< as gpu::Chain
  gpu::PriceState price{};            ///< with a budget of triangles
  bool seen = false;                  ///< a pixel of the last frame showed the object, or no count says
  gpu::ObjectState last{};            ///< of the last frame, where the marks have kMarkKnown or kMarkRemembered
  gpu::uint cover = gpu::kCoverOpen;  ///< as gpu::ScreenBox; with kTraitMasksError it masks errors
  glm::vec3 sizeObject{0.0F};         ///< of the chain's box, object space
};
/// The area is that of the rectangle.
DetailInput detailInput(const scene::SceneData& scene, const gpu::Chain& chain, const gpu::ScreenBox& box, bool seen,
                        const gpu::ObjectState& last);

/// Fills lod and tessellation under the view's rule; without kTraitFollowsError and kTraitFollowsLv they stay.
/// With kMarkRemembered the levels follow the error with hysteresis: the last level stays within the view's margin,
/// changes by one, and is cross-faded. Without it a running cross-fade ends.
/// @param marks  gets kMarkSwitched (only with kMarkKnown) and the frames of the cross-fade
void chooseDetail(const gpu::CullView& view, const DetailInput& object, gpu::ObjectState& state, gpu::uint& marks);

/// The largest deviation that the view's rule allows the object in the present frame, pixels; infinite where the rule
/// does not follow the error. A budget of triangles can allow more.
/// @param state, marks  of the present frame, as chooseDetail left them
float allowedDeviation(const gpu::CullView& view, const DetailInput& object, const gpu::ObjectState& state,
                       gpu::uint marks);

/// The state DetailInput::last of the present frame with a level that is at least as coarse: the one that the rule
/// allows at tau * scale, and with a limit of the largest deviation that is multiplied by scale.
/// @param marks  of the present frame   @param scale  >= 1
gpu::ObjectState coarserState(const gpu::CullView& view, const DetailInput& object, gpu::uint marks, float scale);

}  // namespace jalousie::visibility
