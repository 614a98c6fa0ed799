// Importance of each region of the screen (Tai and Hsu: importance culling), as a pyramid of largest values.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/image.h"

namespace jalousie::visibility {

/// A grey mask stretched over the screen: white has importance 1, black kLeastImportance. GPU twin:
/// shaders/lib/importance.glsl
class ImportanceMask {
 public:
  /// @param image  its luminance counts (Rec. 709 weights of the bytes); row 0 is the top of the screen
  explicit ImportanceMask(const ImageRgba8& image);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Padded to powers of two with zeros, row 0 at the bottom; level 0 first, down to 1x1.
  std::uint32_t levels() const { return static_cast<std::uint32_t>(levels_.size()); }
  std::uint32_t levelWidth(std::uint32_t level) const;
  std::uint32_t levelHeight(std::uint32_t level) const;
  std::span<const std::uint8_t> level(std::uint32_t level) const { return levels_[level]; }

  /// Largest value over a rectangle of the screen (min.xy, max.xy in pixels, origin at the lower left), at a level
  /// where at most 2x2 texels are touched; in [gpu::kLeastImportance, 1].
  float largestIn(const glm::vec4& rect, std::uint32_t viewportWidth, std::uint32_t viewportHeight) const;

 private:
  std::uint32_t width_;
  std::uint32_t height_;
  std::vector<std::vector<std::uint8_t>> levels_;
};

}  // namespace jalousie::visibility
