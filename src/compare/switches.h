// Counts LOD switches of visible objects.
#pragma once

#include <cstdint>

namespace jalousie::render {
class FrameRenderer;
}

namespace jalousie::compare {

struct Switches {
  std::uint64_t visible = 0;   ///< objects with at least one visible pixel
  std::uint64_t switched = 0;  ///< of these, objects drawn at another level than in the frame before
};

/// Counts over the renderer's last frame. Draws its object numbers and waits for the GPU.
Switches countSwitches(render::FrameRenderer& renderer);

}  // namespace jalousie::compare
