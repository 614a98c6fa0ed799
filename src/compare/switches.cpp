// Joins the object numbers of the picture with the flags of the frame.
#include "compare/switches.h"

#include <vector>

#include "render/frame_renderer.h"

namespace jalousie::compare {

Switches countSwitches(render::FrameRenderer& renderer) {
  const std::vector<gpu::uint> marks = renderer.readMarks();
  renderer.renderIds();
  std::vector<bool> seen(marks.size() + 1);  // [0] is the background
  for (const std::uint32_t id : renderer.readIds())
    seen[id] = true;
  Switches result;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!seen[i + 1]) continue;
    ++result.visible;
    result.switched += (marks[i] & gpu::kMarkSwitched) != 0 ? 1 : 0;
  }
  return result;
}

}  // namespace jalousie::compare
