// Compares a frame with a stored image under limits, and leaves pictures when it fails.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/image.h"

namespace jalousie::test {

/// How far a frame may be from its stored image. Drivers differ at edges: few pixels by much, the rest by rounding.
struct ImageLimits {
  double mean = 0.6;          ///< mean absolute difference over all channels, of 255
  int large = 24;             ///< a channel difference above this counts as large
  double largeShare = 0.005;  ///< share of pixels that may have one
};

/// Compares with tests/golden/NAME.png. On failure writes NAME.actual.png, NAME.expected.png and NAME.difference.png
/// (times eight) into the build folder's golden/. With JALOUSIE_UPDATE_GOLDEN=1 in the environment, stores the frame
/// instead.
testing::AssertionResult matchesGolden(const ImageRgba8& frame, const std::string& name,
                                       const ImageLimits& limits = {});

}  // namespace jalousie::test
