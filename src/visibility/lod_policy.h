// From a level of visibility to a level of detail (thesis 4.1.3).
#pragma once

#include <cstdint>

namespace jalousie::visibility {

/// Share of hiddenness in [0, 1]: (clamp(lv, -1, 1) + 1) / 2; 0 open, 1 covered.
/// @param lv  normalised level of visibility; can be below -1
float hiddenShare(float lv);

/// floor(mix(levels, 1, hiddenShare)), in [1, levels]. LV = 641/1024 with 20 levels gives 4.
/// GPU twin: shaders/lib/lod.glsl
std::uint32_t tessellationLevel(float lv, std::uint32_t levels);

/// The same mapping onto a chain: 0 when open, lodCount - 1 when covered. @pre lodCount >= 1
std::uint32_t linearLod(float lv, std::uint32_t lodCount);

}  // namespace jalousie::visibility
