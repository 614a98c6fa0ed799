// Order of the draws: opaque surfaces of both phases, blended ones, points and lines, then what the view adds.
#include "render/frame_drawing.h"

namespace jalousie::render {

void FrameDrawing::draw(const FrameOptions& options, CullMethod& method) {
  const bool frozen = frame_.cullView.clipFromWorld != frame_.drawView.clipFromWorld;
  const bool showsCover = rowOf(options.view).replacesFrame && rowOf(options.cullMode).testsOcclusion;
  glEnable(GL_FRAMEBUFFER_SRGB);
  const bool slices = rowOf(options.cullMode).asksQueries;
  if (frame_.counting) countPixels(slices);
  if (showsCover) {
    const gl::PassTimer::Scope pass(frame_.timer, "view");
    frame_.draw.setView(frame_.drawView);
    frame_.targets.bind(frame_.targets.view);
    method.showCover(frame_);
  } else if (!frame_.counting || frozen) {
    const gl::PassTimer::Scope pass(frame_.timer, twoPhases() ? "late draw" : "draw");
    frame_.draw.setView(frame_.drawView);
    drawObjects(frame_.targets.frame, twoPhases() && !frozen, slices && !frozen);
  }
  drawView(options, frozen);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

/// Pixels count as the culling camera sees them.
void FrameDrawing::countPixels(bool opaqueIsThere) const {
  {
    const gl::PassTimer::Scope pass(frame_.timer, twoPhases() ? "late draw" : "draw");
    frame_.setCullingCamera();
    drawObjects(frame_.targets.counted, twoPhases(), opaqueIsThere);
  }
  const gl::PassTimer::Scope pass(frame_.timer, "count pixels");
  frame_.visibility.countPixels(frame_.targets.id);
}

void FrameDrawing::drawObjects(const gl::Framebuffer& target, bool earlyIsThere, bool lateIsThere) const {
  earlyIsThere || lateIsThere ? frame_.targets.bind(target) : frame_.targets.begin(target);
  glEnable(GL_DEPTH_TEST);
  if (twoPhases() && !earlyIsThere) frame_.drawList(DrawKind::kShaded, DrawPart::kOpaque, frame_.early);
  if (!lateIsThere) frame_.drawList(DrawKind::kShaded, DrawPart::kOpaque, frame_.late);
  if (twoPhases()) frame_.drawList(DrawKind::kShaded, DrawPart::kBlended, frame_.early);
  frame_.drawList(DrawKind::kShaded, DrawPart::kBlended, frame_.late);
  frame_.draw.drawLoose(frame_.scene);
  glDisable(GL_DEPTH_TEST);
}

void FrameDrawing::drawIds() const {
  frame_.draw.setView(frame_.drawView);
  frame_.targets.begin(frame_.targets.ids);
  glEnable(GL_DEPTH_TEST);
  for (const DrawPart part : {DrawPart::kOpaque, DrawPart::kBlended}) {
    if (twoPhases()) frame_.drawList(DrawKind::kId, part, frame_.early);
    frame_.drawList(DrawKind::kId, part, frame_.late);
  }
  glDisable(GL_DEPTH_TEST);
}

void FrameDrawing::drawLeftOutIds() {
  frame_.targets.bind(frame_.targets.ids);
  glEnable(GL_DEPTH_TEST);
  views_.drawLeftOut(drawnFrame(), frame_.draw, frame_.scene, frame_.lists);
  glDisable(GL_DEPTH_TEST);
}

DrawnFrame FrameDrawing::drawnFrame() const {
  return {frame_.drawView, twoPhases(),  &frame_.targets.frame, &frame_.targets.view,
          &frame_.early,   &frame_.late, &frame_.visibility};
}

void FrameDrawing::drawView(const FrameOptions& options, bool frozen) {
  const bool addsBoxes = options.boxes && !frozen;
  const bool addsPass = rowOf(options.view).addsPass;
  if (!addsPass && !addsBoxes) return;
  const gl::PassTimer::Scope pass(frame_.timer, addsPass ? "view" : "boxes");
  views_.draw(drawnFrame(), frame_.draw, frame_.scene, frame_.lists);
  if (!addsBoxes) return;
  frame_.draw.setView(frame_.drawView);
  frame_.targets.bind(frame_.targets.view);
  frame_.draw.drawBoxes(frame_.scene.objectCount(), frame_.visibility.decided());
}

}  // namespace jalousie::render
