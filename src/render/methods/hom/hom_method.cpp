// classify -> occluders -> map -> analyse.
#include "render/methods/hom/hom_method.h"

#include "render/methods/occluders.h"

namespace jalousie::render {

void HomMethod::decide(const FrameContext& frame) noexcept {
  frame.buildList(frame.early, "early list");
  drawOccluders(frame, OccluderDepth::kIgnored);
  reduceMap(frame);
  frame.analyse();
}

void HomMethod::redrawCover(const FrameContext& frame) noexcept {
  drawOccluders(frame, OccluderDepth::kIgnored);
}

void HomMethod::showCover(const FrameContext& frame) noexcept {
  frame.draw.drawMap(frame.map);
}

}  // namespace jalousie::render
