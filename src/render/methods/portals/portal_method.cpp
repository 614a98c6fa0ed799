// follow what moved -> rooms and their rectangles -> objects in them -> marks.
#include "render/methods/portals/portal_method.h"

#include <chrono>

#include "policy/traits.h"

namespace jalousie::render {

void PortalMethod::allocate() {
  scene_->allocate();
  if (culling_) return;
  culling_.emplace(sceneData_.rooms, sceneData_.objects.size());
  culling_->follow(scene_->boundsWorld());
  movement_ = scene_->movement();
}

void PortalMethod::decide(const FrameContext& frame) noexcept {
  const gl::PassTimer::Scope pass(frame.timer, "portals");
  const gpu::CullView& view = frame.cullView;
  // Curved patches of walls may lie inside of what the triangles close.
  if (sceneData_.rooms.empty() || has(view.traits, gpu::kTraitPatches)) return;
  scene_->follow(frame.scene);
  const auto start = std::chrono::steady_clock::now();
  if (movement_ != scene_->movement()) {
    culling_->follow(scene_->boundsWorld());
    movement_ = scene_->movement();
  }
  const culling::PortalView portalView =
      culling::makePortalView(view.clipFromWorld, view.cameraWorld, view.forwardWorld, view.focalPixels,
                              {view.viewportWidth, view.viewportHeight});
  const std::span<const std::uint32_t> notHidden =
      culling_->cull(portalView, scene_->boundsWorld(), scene_->order().placeOf, frame.occluderOptions.portalReach,
                     frame.queryFigures);
  frame.queryFigures.decisionNs =
      static_cast<std::uint64_t>(std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count());
  if (!notHidden.empty()) scene_->slices().hideKnown(frame.scene.bindings(), frame.visibility.decided(), notHidden);
}

}  // namespace jalousie::render
