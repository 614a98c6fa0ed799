// follow what moved -> choose occluders -> test the hierarchy -> marks.
#include "render/methods/shadows/shadow_method.h"

#include <chrono>

#include "policy/traits.h"

namespace jalousie::render {

void ShadowMethod::allocate() {
  scene_->allocate();
  if (table_) return;
  table_.emplace(sceneData_, use_);
  active_.emplace(table_->placed().size());
  culling_.emplace(2 * sceneData_.objects.size() + 1, sceneData_.objects.size());
}

void ShadowMethod::forget() {
  if (active_) active_->forget();
}

void ShadowMethod::decide(const FrameContext& frame) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "shadows");
  const gpu::CullView& view = frame.cullView;
  // Curved patches may lie inside of what the triangles enclose.
  if (table_->placed().empty() || has(view.traits, gpu::kTraitPatches)) return;
  scene_->follow(frame.scene);
  const auto start = std::chrono::steady_clock::now();
  if (movement_ != scene_->movement()) {
    table_->follow(sceneData_.objects, scene_->transforms());
    movement_ = scene_->movement();
  }
  const culling::QueryView queryView =
      culling::makeQueryView(view.clipFromWorld, view.cameraWorld, view.forwardWorld, view.focalPixels,
                             {view.viewportWidth, view.viewportHeight});
  const bool everyLevel = (view.traits & (gpu::kTraitFollowsError | gpu::kTraitFollowsLv)) != 0;
  const std::span<const culling::CastShadow> shadows =
      active_->cast(queryView, frame.occluderOptions,
                    {*table_, sceneData_.objects, scene_->transforms(), scene_->boundsWorld(), everyLevel});
  frame.queryFigures.shadows = shadows.size();
  const std::span<const std::uint32_t> notHidden =
      culling_->cull(scene_->tree(), queryView, shadows, frame.queryFigures);
  frame.queryFigures.decisionNs =
      static_cast<std::uint64_t>(std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count());
  if (!shadows.empty()) scene_->slices().hideKnown(frame.scene.bindings(), frame.visibility.decided(), notHidden);
}

}  // namespace jalousie::render
