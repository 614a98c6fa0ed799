// The modes whose occluders are known before the frame (docs/object_space_occlusion.md).
#pragma once

#include <memory>
#include <optional>

#include "culling/occluder_culling.h"
#include "render/methods/cull_method.h"
#include "render/query_scene.h"

namespace jalousie::render {

/// Finds on the CPU which objects lie in the shadow of an occluder, and corrects the marks of classify.comp: the frame
/// is then drawn as with frustum culling. Reads no depth. Where objects move, their transforms are read back.
class ShadowMethod : public CullMethod {
 public:
  /// @param scene  shared by the modes with the same hierarchy
  ShadowMethod(const scene::SceneData& sceneData, std::shared_ptr<QueryScene> scene, culling::OccluderUse use)
      : sceneData_(sceneData), scene_(std::move(scene)), use_(use) {}

  void allocate() override;
  void forget() override;
  void decide(const FrameContext& frame) noexcept override;

 private:
  const scene::SceneData& sceneData_;
  std::shared_ptr<QueryScene> scene_;
  culling::OccluderUse use_;
  std::optional<culling::OccluderTable> table_;
  std::optional<culling::ActiveSet> active_;
  std::optional<culling::OccluderCulling> culling_;
  std::uint64_t movement_ = 0;  ///< QueryScene::movement of the table
};

}  // namespace jalousie::render
