// The cover of a block in two halves, and what follows from it.
#include "visibility/masking.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "policy/traits.h"
#include "shared/limits.h"
#include "visibility/hiddenness.h"

namespace jalousie::visibility {

gpu::uint packedCover(const Block& opacity, float texelPixels) {
  constexpr float kMostTexels = 32768.0F;  // the largest power of two that a half holds
  std::vector<float> open(opacity.values.begin(), opacity.values.end());
  for (float& value : open)
    value = 1.0F - value;
  const Block transmittance{opacity.width, opacity.height, open};
  const float chord = meanOpenChord(transmittance);
  return glm::packHalf2x16({1.0F - openShare(transmittance), (std::isinf(chord) ? kMostTexels : chord) * texelPixels});
}

float maskingFactor(gpu::uint cover) {
  const glm::vec2 shareAndChord = glm::unpackHalf2x16(cover);
  if (!(shareAndChord.x > 0.0F) || !(shareAndChord.y < gpu::kMaskingPixels)) return 1.0F;
  return std::pow(gpu::kMaskingPixels / std::max(shareAndChord.y, 1.0F), gpu::kMaskingExponent);
}

float maskingInUse(gpu::uint cover, gpu::uint traits) {
  return has(traits, gpu::kTraitMasksError) ? maskingFactor(cover) : 1.0F;
}

}  // namespace jalousie::visibility
