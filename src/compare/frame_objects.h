// What a frame shows of its objects, and what its culling left out wrongly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace jalousie::render {
class FrameRenderer;
}

namespace jalousie::compare {

/// 1 for each pixel that shows an object; [height * width], row 0 at the top. @param ids  FrameRenderer::readIds()
std::vector<std::uint8_t> coveredPixels(const std::vector<std::uint32_t>& ids, std::size_t width);

struct FrameObjects {
  std::uint64_t visible = 0;      ///< objects with at least one visible pixel
  std::uint64_t switched = 0;     ///< of these, objects drawn at another level than in the frame before
  std::uint64_t lost = 0;         ///< objects that the frame left out although nothing that it drew hides them
  std::uint64_t wrongPixels = 0;  ///< pixels that show something else than they would without culling
  /// coveredPixels, of objects that the frame left out, too
  std::vector<std::uint8_t> covered;
};

/// Looks at the renderer's last frame. Objects that it left out are drawn over it, at their coarsest level. Draws
/// object numbers and waits for the GPU.
FrameObjects countObjects(render::FrameRenderer& renderer);

}  // namespace jalousie::compare
