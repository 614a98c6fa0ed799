// Joins the object numbers of the picture with the flags of the frame.
#include "compare/frame_objects.h"

#include <cstddef>

#include "render/frame_renderer.h"

namespace jalousie::compare {

FrameObjects countObjects(render::FrameRenderer& renderer) {
  const std::vector<gpu::uint> marks = renderer.readMarks();
  renderer.renderIds();
  const std::vector<std::uint32_t> drawn = renderer.readIds();
  renderer.renderLeftOutIds();
  const std::vector<std::uint32_t> whole = renderer.readIds();
  FrameObjects result;
  std::vector<bool> isDrawn(marks.size() + 1);  // [0] is the background
  std::vector<bool> isSeen(marks.size() + 1);
  result.covered.resize(whole.size());
  const std::size_t width = renderer.width();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    isDrawn[drawn[i]] = true;
    isSeen[whole[i]] = true;
    result.wrongPixels += drawn[i] != whole[i] ? 1 : 0;
    const std::size_t fromTop = whole.size() / width - 1 - i / width;
    result.covered[fromTop * width + i % width] = whole[i] != 0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    result.lost += isSeen[i + 1] && !isDrawn[i + 1] ? 1 : 0;
    if (!isDrawn[i + 1]) continue;
    ++result.visible;
    result.switched += (marks[i] & gpu::kMarkSwitched) != 0 ? 1 : 0;
  }
  return result;
}

}  // namespace jalousie::compare
