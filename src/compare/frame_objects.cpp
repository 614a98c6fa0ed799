// Joins the object numbers of the picture with the flags of the frame.
#include "compare/frame_objects.h"

#include "render/frame_renderer.h"

namespace jalousie::compare {

std::vector<std::uint8_t> coveredPixels(const std::vector<std::uint32_t>& ids, std::size_t width) {
  std::vector<std::uint8_t> covered(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::size_t fromTop = ids.size() / width - 1 - i / width;
    covered[fromTop * width + i % width] = ids[i] != 0 ? 1 : 0;
  }
  return covered;
}

FrameObjects countObjects(render::FrameRenderer& renderer) {
  const std::vector<gpu::uint> marks = renderer.readMarks();
  renderer.renderIds();
  const std::vector<std::uint32_t> drawn = renderer.readIds();
  renderer.renderLeftOutIds();
  const std::vector<std::uint32_t> whole = renderer.readIds();
  FrameObjects result;
  std::vector<bool> isDrawn(marks.size() + 1);  // [0] is the background
  std::vector<bool> isSeen(marks.size() + 1);
  result.covered = coveredPixels(whole, renderer.width());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    isDrawn[drawn[i]] = true;
    isSeen[whole[i]] = true;
    result.wrongPixels += drawn[i] != whole[i] ? 1 : 0;
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
