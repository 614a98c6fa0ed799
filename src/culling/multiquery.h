// Which hidden nodes ask together: the laws of CHC++ (Mattausch et al. 2008), as numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "culling/query_options.h"

namespace jalousie::culling {

/// p(t) = 0.99 - 0.7 e^-t: how likely a node is to be hidden again that was found hidden in t frames in a row.
double persistence(std::uint32_t framesHidden);

/// A node that was hidden.
struct HiddenNode {
  std::uint32_t framesHidden = 0;
  std::uint32_t objects = 0;
};

/// How many of the first nodes ask together, at least 1 if there are any: nodes are added while the value of the query
/// grows. With i the product of p(t) over M nodes it is M / (1 + (1 - i) M) for kNodes, nodes saved over queries
/// expected, and i * objects / (1 + 0.1 M) for kObjects.
/// @param nodes  by falling framesHidden
std::size_t multiquerySize(std::span<const HiddenNode> nodes, Multiquery kind);

}  // namespace jalousie::culling
