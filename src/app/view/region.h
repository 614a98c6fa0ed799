// Rectangle of the window that shows one document, and its parts left and right of the divider.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace jalousie::app {

/// Pixels of the framebuffer, origin at the upper left.
struct Region {
  float x = 0.0F;
  float y = 0.0F;
  float width = 0.0F;
  float height = 0.0F;

  bool holds(const glm::vec2& p) const { return p.x >= x && p.x < x + width && p.y >= y && p.y < y + height; }
  /// Columns left of the divider. @param share  position of the divider, share of the width
  float dividerColumns(float share) const { return std::round(share * width); }
  Region leftOf(float share) const { return {x, y, dividerColumns(share), height}; }
  Region rightOf(float share) const { return {x + dividerColumns(share), y, width - dividerColumns(share), height}; }
};

}  // namespace jalousie::app
