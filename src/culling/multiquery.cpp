// Greedy: the value first grows with the number of nodes, then falls.
#include "culling/multiquery.h"

#include <cmath>

namespace jalousie::culling {

double persistence(std::uint32_t framesHidden) {
  return 0.99 - 0.7 * std::exp(-static_cast<double>(framesHidden));
}

std::size_t multiquerySize(std::span<const HiddenNode> nodes, Multiquery kind) {
  if (nodes.empty() || kind == Multiquery::kOff) return nodes.empty() ? 0 : 1;
  constexpr double kBoxCost = 0.1;  // of one box, over the cost of a query
  double hidden = 1.0;
  double objects = 0.0;
  double best = 0.0;
  std::size_t size = 0;
  for (const HiddenNode& node : nodes) {
    const auto count = static_cast<double>(size + 1);
    hidden *= persistence(node.framesHidden);
    objects += node.objects;
    const double value = kind == Multiquery::kNodes ? count / (1.0 + (1.0 - hidden) * count)
                                                    : hidden * objects / (1.0 + kBoxCost * count);
    if (size > 0 && !(value > best)) break;
    best = value;
    ++size;
  }
  return size;
}

}  // namespace jalousie::culling
