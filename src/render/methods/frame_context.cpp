// Steps that several culling methods share.
#include "render/methods/frame_context.h"

namespace jalousie::render {

void FrameContext::buildList(visibility::DrawList& list, const char* name) const {
  const gl::PassTimer::Scope pass(timer, name);
  lists.build(list, scene.bindings(), visibility.decided());
}

void FrameContext::limitTriangles(const visibility::DrawList& list) const {
  if (cullView.triangleBudget == 0) return;
  const gl::PassTimer::Scope pass(timer, "budget");
  budget.limit(scene.bindings(), visibility.decided(), cullView, list);
  visibility.repeatCells(scene.bindings(), cullView.traits, budget.words(), list.view().phase);
}

void FrameContext::setCullingCamera(float depthGuard) const {
  gpu::DrawView view = drawView;
  view.clipFromWorld = cullView.clipFromWorld;
  view.cameraWorld = cullView.cameraWorld;
  view.forwardWorld = cullView.forwardWorld;
  view.depthGuard = depthGuard;
  draw.setView(view);
}

void FrameContext::drawList(DrawKind kind, DrawPart part, const visibility::DrawList& list) const {
  draw.draw(kind, part, scene, list, visibility.decided());
}

void FrameContext::buildPyramid(visibility::DepthSource source) const {
  const gl::PassTimer::Scope pass(timer, "depth pyramid");
  pyramid.build(targets.depth, source);
}

void FrameContext::analyse() const {
  const gl::PassTimer::Scope pass(timer, "analyse");
  visibility.analyse(scene.bindings(), cullView.traits, {&map.texture(), &pyramid.texture(), &targets.depth});
}

}  // namespace jalousie::render
