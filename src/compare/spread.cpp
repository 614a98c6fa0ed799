// Quantiles of a sorted list.
#include "compare/spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace jalousie::compare {

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto lower = static_cast<std::size_t>(place);
    const std::size_t upper = std::min(lower + 1, values.size() - 1);
    return std::lerp(values[lower], values[upper], place - static_cast<double>(lower));
  };
  return {at(0.5), at(0.25), at(0.75)};
}

}  // namespace jalousie::compare
