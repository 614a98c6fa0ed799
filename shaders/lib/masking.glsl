// Visual masking: an error counts less where it is seen through small holes. CPU twin: src/visibility/masking.cpp
// Include lib/traits.glsl before.

/// Factor by which an error behind a block counts less, in [1, 64^0.3 = 3.48]; 1 with nothing in front.
/// @param cover  as ScreenBox.cover; anything else gives a factor in the same range
float maskingFactor(uint cover) {
  vec2 shareAndChord = unpackHalf2x16(cover);
  if (!(shareAndChord.x > 0.0) || !(shareAndChord.y < kMaskingPixels)) return 1.0;
  return pow(kMaskingPixels / max(shareAndChord.y, 1.0), kMaskingExponent);
}

/// The factor that the choice of detail uses: 1 without kTraitMasksError.
float maskingInUse(uint cover) { return hasTrait(kTraitMasksError) ? maskingFactor(cover) : 1.0; }
