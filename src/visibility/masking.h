// Visual masking: an error counts less where it is seen through small holes. GPU twin: shaders/lib/masking.glsl
#pragma once

#include "shared/frame_structs.h"
#include "visibility/level_of_visibility.h"

namespace jalousie::visibility {

/// gpu::ScreenBox::cover of a block: its covered share and its mean open chord in pixels, at most 32768 texels.
/// @param opacity  of the block   @param texelPixels  side of a texel
gpu::uint packedCover(const Block& opacity, float texelPixels);

/// Factor by which an error behind a block counts less: (64 / d)^0.3 with the mean open chord d clamped to [1, 64]
/// pixels, so in [1, 3.48]; 1 with nothing in front (docs/level_of_visibility.md).
/// @param cover  as gpu::ScreenBox; anything else gives a factor in the same range
float maskingFactor(gpu::uint cover);

/// The factor that the choice of detail uses: 1 without kTraitMasksError. @param traits  gpu::CullView::traits
float maskingInUse(gpu::uint cover, gpu::uint traits);

}  // namespace jalousie::visibility
