// Occluders are drawn from the culling camera, opaque surfaces only.
#include "render/methods/occluders.h"

namespace jalousie::render {

void drawOccluders(const FrameContext& frame, OccluderDepth depth) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "occluders");
  const bool tested = depth == OccluderDepth::kTested;
  // A coarser level may lie in front of the true surface by its error: the guard moves it behind.
  frame.setCullingCamera(tested ? frame.cullView.occluderTau / frame.cullView.focalPixels : 0.0F);
  frame.map.beginOccluders(tested);
  if (tested) glEnable(GL_DEPTH_TEST);
  frame.drawList(DrawKind::kOpacity, DrawPart::kOpaque, frame.early);
  glDisable(GL_DEPTH_TEST);
}

void reduceMap(const FrameContext& frame) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "reduce map");
  frame.map.reduce();
}

}  // namespace jalousie::render
