// From a level of visibility (thesis 4.1.3) or a size on screen to a level of detail. GPU twin: shaders/lib/lod.glsl
#pragma once

#include <cstdint>
#include <span>

#include "shared/frame_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::visibility {

/// Share of hiddenness in [0, 1]: (clamp(lv, -1, 1) + 1) / 2; 0 open, 1 covered.
/// @param lv  normalised level of visibility; can be below -1
float hiddenShare(float lv);

/// floor(mix(levels, 1, hiddenShare)), in [1, levels]. LV = 641/1024 with 20 levels gives 4.
std::uint32_t tessellationLevel(float lv, std::uint32_t levels);

/// The same mapping onto a chain: 0 when open, lodCount - 1 when covered. @pre lodCount >= 1
std::uint32_t linearLod(float lv, std::uint32_t lodCount);

/// 1 - hiddenShare(lv), at least kLeastShare.
float visibleShare(float lv);

/// How much a hidden object's budget grows: (1 - hiddenShare(lv))^(-1/4), at most 1 + relax (docs/lod_selection.md).
float relaxedBudget(float lv, float relax);

/// LV of an object of which `visible` pixels showed, in a rectangle of `area` pixels: 1 - 2 s with the visible share
/// s = min((visible + kPixelGuard) / (kSilhouetteShare * area + kPixelGuard), 1).
float pixelsLv(float visible, float area);

/// LV on its way from the last frame's value to the one just measured: quick when the object comes into sight.
float smoothLv(float last, float measured);
/// LV of what is out of view: nothing is known of it, and after a while it counts as open.
float forgottenLv(float last);

/// Pixels that an error of one object-space unit can cover: scale * focalPixels / max(distance - radius, zNear).
/// @param scale  world units per object unit   @param distance  from the eye to the centre of the bounding sphere
float projectedScale(float scale, float focalPixels, float distance, float radius, float zNear);

/// Coarsest level with errorObject * pixelsPerUnit <= tau; 0 if none. A level of unknown (infinite) error is never it.
std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau);

/// Level between the ones that tau and tau * relaxed allow: the one with the least share * (error / tau)^2 + triangles
/// / (triangles at tau). A coarser level that saves little is not worth its error. @param share  visible, (0, 1]
std::uint32_t relaxedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau, float relaxed, float share);

/// Lowest level in [1, maxLevel] whose flat pieces stay within tau of the curved surface: errorPixels / level^2 <= tau.
/// @param errorPixels  projected gap between the untessellated base and its curved surface
std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel);

/// Frames that a cross-fade still takes, this one included; 0: none.
std::uint32_t fadeFrames(gpu::uint marks);
/// The level that fades out. @pre fadeFrames(marks) > 0
std::uint32_t fadingLod(std::uint32_t lod, gpu::uint marks);

/// One step from the last level towards [lowest, highest].
std::uint32_t stepTowards(std::uint32_t last, std::uint32_t lowest, std::uint32_t highest);

/// Fills lod and tessellation under the view's rule; a rule with neither kTraitFollowsError nor kTraitFollowsLv leaves
/// them. With kMarkRemembered the object goes on from the last frame: it keeps its level within the view's hysteresis,
/// changes it by one, and fades; without, a fade that was on ends.
/// @param patchError  errorObject of the patch base   @param last  the object in the last frame
/// @param seen  whether a pixel of the last frame showed the object, or nobody knows: what is unseen need not fade
/// @param marks  gets kMarkSwitched (only what was drawn before, kMarkKnown, can switch) and the frames of the fade
void chooseDetail(const gpu::CullView& view, std::span<const gpu::Lod> levels, float patchError,
                  const gpu::ScreenBox& box, bool seen, const gpu::ObjectState& last, gpu::ObjectState& state,
                  gpu::uint& marks);

}  // namespace jalousie::visibility
