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

/// How much a hidden object's budget grows: 1 + relax * hiddenShare(lv)^kRelaxPower.
float relaxedBudget(float lv, float relax);

/// Pixels that an error of one object-space unit can cover: scale * focalPixels / max(distance - radius, zNear).
/// @param scale  world units per object unit   @param distance  from the eye to the centre of the bounding sphere
float projectedScale(float scale, float focalPixels, float distance, float radius, float zNear);

/// Coarsest level with errorObject * pixelsPerUnit <= tau; 0 if none. A level of unknown (infinite) error is never it.
std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau);

/// Lowest level in [1, maxLevel] whose flat pieces stay within tau of the curved surface: errorPixels / level^2 <= tau.
/// @param errorPixels  projected gap between the untessellated base and its curved surface
std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel);

/// Fills lod and tessellation under the view's rule; kLodFinest leaves them.
/// @param patchError  errorObject of the patch base
void chooseDetail(const gpu::CullView& view, std::span<const gpu::Lod> levels, float patchError,
                  const gpu::ScreenBox& box, gpu::ObjectState& state);

}  // namespace jalousie::visibility
