// Median and quartiles of measured values.
#pragma once

#include <vector>

namespace jalousie::compare {

struct Spread {
  double median = 0.0;
  double lower = 0.0;  ///< first quartile
  double upper = 0.0;  ///< third quartile
};

/// Quantiles at a position between two values are interpolated linearly. All are 0 for no values. O(n log n)
Spread spreadOf(std::vector<double> values);

}  // namespace jalousie::compare
