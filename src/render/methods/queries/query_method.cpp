// follow what moved -> commands -> slices and queries -> marks.
#include "render/methods/queries/query_method.h"

namespace jalousie::render {

void QueryMethod::allocate() {
  scene_->allocate();
  if (schedule_) return;
  schedule_ = culling::makeSchedule(method_, scene_->tree(), scene_->grid());
  version_ = scene_->version();
}

void QueryMethod::forget() {
  if (schedule_) schedule_->forget(scene_->queries());
}

void QueryMethod::decide(const FrameContext& frame) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "queries");
  if (frame.scene.objectCount() > 0) {
    scene_->follow(frame.scene);
    if (version_ != scene_->version()) {
      schedule_->forget(scene_->queries());
      version_ = scene_->version();
    }
    scene_->slices().begin(frame.scene.bindings(), frame.visibility.decided(), frame.queryOptions, frame.sliceFaces());
  }
  frame.setCullingCamera();
  glEnable(GL_FRAMEBUFFER_SRGB);  // before the clear: it converts the background too
  frame.targets.begin(frame.counting ? frame.targets.counted : frame.targets.frame);
  glEnable(GL_DEPTH_TEST);
  if (frame.scene.objectCount() > 0) run(frame);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void QueryMethod::run(const FrameContext& frame) {
  const gpu::CullView& view = frame.cullView;
  const culling::QueryView queryView =
      culling::makeQueryView(view.clipFromWorld, view.cameraWorld, view.forwardWorld, view.focalPixels,
                             {view.viewportWidth, view.viewportHeight});
  QueryPass& queries = scene_->queries();
  queries.begin(frame, scene_->slices(), scene_->order(), deferred_);
  schedule_->run(queryView, frame.queryOptions, queries);
  queries.finish();
  frame.queryFigures = queries.figures();
  frame.queryFigures.sliceDraws = queries.drawCalls();
  scene_->slices().hide(frame.scene.bindings(), frame.visibility.decided(), queries.drawn());
}

}  // namespace jalousie::render
