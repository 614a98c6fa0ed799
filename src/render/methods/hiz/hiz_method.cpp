// classify -> early list -> early draw -> depth pyramid -> analyse.
#include "render/methods/hiz/hiz_method.h"

namespace jalousie::render {
namespace {

/// The first phase goes into the frame itself, opaque surfaces only: blended ones do not occlude.
void drawFirstPhase(const FrameContext& frame, bool counting) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "early draw");
  frame.setCullingCamera();
  glEnable(GL_FRAMEBUFFER_SRGB);  // before the clear: it converts the background too
  frame.targets.begin(counting ? frame.targets.counted : frame.targets.frame);
  glEnable(GL_DEPTH_TEST);
  frame.drawList(DrawKind::kShaded, DrawPart::kOpaque, frame.early);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace

void HizMethod::decide(const FrameContext& frame) noexcept {
  frame.limitTriangles(frame.early);
  frame.buildList(frame.early, "early list");
  drawFirstPhase(frame, frame.counting);
  frame.buildPyramid(visibility::DepthSource::kAll);
  frame.analyse();
}

void HizMethod::redrawCover(const FrameContext& frame) noexcept {
  drawFirstPhase(frame, /*counting=*/false);
}

void HizMethod::showCover(const FrameContext& frame) noexcept {
  frame.draw.drawPyramid(frame.pyramid, frame.targets.depth);
}

}  // namespace jalousie::render
