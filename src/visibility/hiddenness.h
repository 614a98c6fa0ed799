// How hidden a block of what lies in front makes an object: measures in [0, 1] that relax its budget.
#pragma once

#include <cstdint>
#include <span>

#include "shared/frame_structs.h"
#include "visibility/level_of_visibility.h"

namespace jalousie::visibility {

/// Open share V of a block of transmittances (1 = open).
float openShare(const Block& transmittance);

/// How finely divided the open area is: phi = 1 - E_low / E, E = V (1 - V), E_low = sum of F(u,v)^2 / (NM) over
/// 0 <= u, v <= 2 without DC; in [0, 1], 0 if the block is open or covered. Near 1: many small holes.
float spectralFineness(const Block& transmittance);

/// Mean length of the open runs along rows and columns, texels: 2 V / e with e the share of neighbouring texel pairs
/// that differ (of their absolute difference). Infinite where nothing differs and something is open; 0 if all is
/// covered.
float meanOpenChord(const Block& transmittance);

/// Level of visibility of a block of opacities that is neither covered nor open. GPU twin: shaders/lib/hiddenness.glsl
/// The measure is the kTraitLv... that is set:
///   thesis            the thesis' own level of visibility, which may lie below -1
///   spectral          2 h - 1 with h = covered share * fineness
///   chord             2 h - 1 with h = covered share / (1 + chord / kChordPixels)
///   coverage, pixels  2 h - 1 with h = covered share; for pixels this holds until the first count
///   none of them      -1
/// @param traits  gpu::CullView::traits   @param texelPixels  side of a texel in pixels; only chord uses it
float blockLv(gpu::uint traits, const Block& opacity, float texelPixels);

}  // namespace jalousie::visibility
