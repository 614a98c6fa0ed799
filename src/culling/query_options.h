// Parameters of the methods that ask hardware occlusion queries.
#pragma once

#include <cstdint>

namespace jalousie::culling {

/// How nodes that were hidden are put together into one query (Mattausch et al. 2008).
enum class Multiquery : std::uint8_t {
  kOff,      ///< one query a node
  kNodes,    ///< value = nodes saved over queries expected, as in the authors' code
  kObjects,  ///< value = objects that need not be drawn over the cost of the query, as in the lecture
};

/// The defaults are the values of the papers.
struct QueryOptions {
  /// T: a node is hidden if at most so many samples of its box pass. Above 0 visible pixels can be lost.
  std::uint32_t threshold = 0;
  std::uint32_t batch =
      50;  ///< queries that are sent together, and that stay unanswered while work goes on; at least 1
  Multiquery multiquery = Multiquery::kNodes;
  /// A node asks with the boxes of its descendants, up to three levels below it, while their surface is at most so many
  /// times its own; 0: with its own box.
  float tightBounds = 1.4F;
  std::uint32_t requery = 7;  ///< frames for which a visible leaf is taken for visible; 0: every leaf asks every frame
  std::uint32_t planeDepth = 3;  ///< nodes above this depth are tested against the view's planes, others by their query
  /// Samples where the importance mask is below this do not count; above 0 visible pixels can be lost. Without a mask
  /// it has no effect.
  float importance = 0.0F;
  bool unitsTogether = true;  ///< nodes that cannot hide each other ask together; false: one after the other
};

}  // namespace jalousie::culling
