// Compares a frame with a stored image under limits, and writes pictures on failure.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/image.h"

namespace jalousie::test {

/// How far a frame may be from its stored image. Drivers rasterise silhouettes differently and round shading
/// differently: few pixels differ by much, the others by rounding. All limits apply. Differences are of 8-bit channels,
/// 0 to 255.
struct ImageLimits {
  double mean = 0.6;          ///< mean absolute difference over all channels
  int large = 24;             ///< a channel difference above this counts as large
  double largeShare = 0.005;  ///< share of the pixels that may have a large difference
  /// Largest difference of any pixel from the nearest of the 3 x 3 stored pixels around it: at a silhouette that moved
  /// by a pixel the colour is one of the neighbours', so a larger difference is a colour that does not belong there.
  int maximum = 48;
};

/// What was found, in the terms of ImageLimits.
struct ImageDifference {
  double mean = 0.0;
  double largeShare = 0.0;
  int maximum = 0;
  ImageRgba8 picture;  ///< absolute differences times eight
};

/// @pre both have the same size (checked)
ImageDifference differenceOf(const ImageRgba8& frame, const ImageRgba8& expected, const ImageLimits& limits = {});

/// Compares a frame with an image. On failure writes NAME.actual.png, NAME.expected.png and NAME.difference.png into
/// the build folder's golden/ and names them.
testing::AssertionResult matchesImage(const ImageRgba8& frame, const ImageRgba8& expected, const std::string& name,
                                      const ImageLimits& limits = {});

/// matchesImage with tests/golden/NAME.png. With JALOUSIE_UPDATE_GOLDEN=1 in the environment, stores the frame instead.
testing::AssertionResult matchesGolden(const ImageRgba8& frame, const std::string& name,
                                       const ImageLimits& limits = {});

}  // namespace jalousie::test
