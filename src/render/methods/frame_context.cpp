// Steps that several culling methods share.
#include "render/methods/frame_context.h"

#include <algorithm>

#include "policy/traits.h"

namespace jalousie::render {

bool FrameContext::cullsFaces() const {
  return faces != nullptr && faceCulling != FaceCulling::kOff && !has(cullView.traits, gpu::kTraitPatches);
}

bool FrameContext::cullsFaces(const visibility::DrawList& list) const {
  if (!cullsFaces()) return false;
  return list.view().phase == gpu::kMarkLate || has(cullView.traits, gpu::kTraitTwoPhases);
}

void FrameContext::buildList(visibility::DrawList& list, const char* name) const {
  {
    const gl::PassTimer::Scope pass(timer, name);
    lists.build(list, scene.bindings(), visibility.decided());
  }
  if (!cullsFaces(list)) return;
  const gl::PassTimer::Scope pass(timer, "back faces");
  const visibility::FaceWork& work = list.view().phase == gpu::kMarkLate ? faces->late : faces->early;
  // The figures of a frame drawn in slices are those of the late list.
  const bool slices = rowOf(cullMode).asksQueries;
  const std::uint32_t ranges = slices ? std::min(work.ranges(), faces->rangesInSlices) : work.ranges();
  faces->pass.cull(list, work, {static_cast<gpu::uint>(faceCulling), ranges, 0, 0}, scene.transforms(),
                   *visibility.decided().view);
}

SliceFaces FrameContext::sliceFaces() const {
  return cullsFaces() ? SliceFaces{&faces->pass, static_cast<gpu::uint>(faceCulling)} : SliceFaces{};
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
