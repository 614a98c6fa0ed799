// The level of visibility (LV): how occluded an object behind a block of the occlusion map is (thesis 3.5).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace jalousie::visibility {

/// A block of values f(i, j), row by row: i along a row (0..width-1), j over rows (0..height-1).
struct Block {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const float> values;  ///< [width * height]
};

/// The four coefficients LV is made of; F(u, v) with u along rows.
struct LowCoefficients {
  float f00 = 0.0F;
  float f10 = 0.0F;
  float f01 = 0.0F;
  float f11 = 0.0F;
};

/// cos(pi (2i + 1) / 2N) at [16 (N - 1) + i] for N = 1..16; zero where i >= N. The kernels use the
/// same table.
std::array<float, 256> cosineTable();

/// One coefficient F(u, v) of dct2d. O(NM).
double dctCoefficient(const Block& block, std::uint32_t u, std::uint32_t v);

/// Orthonormal 2D DCT-II, all coefficients, F(u, v) at [v * width + u]. Eq. 3.2 with the factors the thesis' own
/// numbers need: a(0, N) = sqrt(1/N), a(u, N) = sqrt(2/N) for u > 0. O(N^2 M^2) in double; for tests and small blocks.
std::vector<double> dct2d(const Block& block);

/// The four lowest coefficients by the separable sums the kernel uses: row sums against {1, cos}, then columns.
/// @pre sides 1..16 (checked)
LowCoefficients lowCoefficients(const Block& block);

/// LV = F00 - (|F10| + |F01| + |F11|), Eq. 3.3, in the unit of the block's values.
float levelOfVisibility(const LowCoefficients& coefficients);

/// LV divided by (P/2) sqrt(NM) for values in [-P/2, P/2]: 1 = fully covered, -1 = fully open, comparable across block
/// sizes. The minimum over all blocks is below -1 (8x8: -1.83).
float normalisedLv(float lv, float range, std::uint32_t width, std::uint32_t height);

/// LVn of a block of opacities in [0, 1]. A block whose longer side is below kMinSpectrumSide counts by its mean alone.
/// GPU twin: shaders/visibility/analyse.comp
float levelOfVisibilityOfOpacity(const Block& opacity);

}  // namespace jalousie::visibility
