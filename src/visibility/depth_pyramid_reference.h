// Plain CPU twin of the farthest-depth pyramid (docs/two_phase_culling.md).
#pragma once

#include <span>
#include <vector>

#include "visibility/map_layout.h"

namespace jalousie::visibility {

/// The pyramid over a depth buffer. Depth is reversed: 0 is infinitely far, so the farthest is the smallest. Level L
/// holds the farthest depth of the pixels a texel stands for; level 0 is the buffer itself. Texels without pixels
/// hold 1.
class DepthPyramidReference {
 public:
  /// @param depth    [screenWidth * screenHeight], window depth, row 0 at the bottom
  /// @param covered  only pixels with depth > 0 count above level 0: the farthest depth of the covered pixels
  DepthPyramidReference(const MapLayout& layout, std::span<const float> depth, bool covered);

  const MapLayout& layout() const { return layout_; }
  /// @pre the texel has area at level 0 (checked)
  float farthest(std::uint32_t x, std::uint32_t y, std::uint32_t level) const;
  /// A whole level above 0, with its padding.
  std::span<const float> level(std::uint32_t level) const { return levels_[level]; }

 private:
  MapLayout layout_;
  std::vector<std::vector<float>> levels_;  ///< level 0 has the screen's size, the others the layout's
};

}  // namespace jalousie::visibility
