// Colours of files are sRGB, those of glTF materials and vertices linear.
#pragma once

#include <cmath>

namespace jalousie::bake {

/// @param value  in [0, 1]
inline float linearFromSrgb(double value) {
  return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

}  // namespace jalousie::bake
