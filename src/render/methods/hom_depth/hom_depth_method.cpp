// classify -> occluders with depth -> map and depth pyramid -> analyse.
#include "render/methods/hom_depth/hom_depth_method.h"

#include "render/methods/occluders.h"

namespace jalousie::render {

void HomDepthMethod::decide(const FrameContext& frame) noexcept {
  frame.buildList(frame.early, "early list");
  drawOccluders(frame, OccluderDepth::kTested);
  reduceMap(frame);
  frame.buildPyramid(visibility::DepthSource::kCovered);
  frame.analyse();
}

void HomDepthMethod::redrawCover(const FrameContext& frame) noexcept {
  drawOccluders(frame, OccluderDepth::kTested);
}

void HomDepthMethod::showCover(const FrameContext& frame) noexcept {
  frame.draw.drawMap(frame.map);
}

}  // namespace jalousie::render
