// The median of measured values, for times that a few slow runs must not shift.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/check.h"

namespace jalousie {

/// Value in the middle of the sorted order; of an even number of values the larger of the two in the middle, so that
/// the result is always a measured value. O(n). @pre values not empty (checked)
template <class Value>
Value median(std::vector<Value> values) {
  JAL_CHECK(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace jalousie
