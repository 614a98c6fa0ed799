// The mode that sees the rooms of a file through their portals (docs/cells_and_portals.md).
#pragma once

#include <memory>
#include <optional>

#include "culling/portal_culling.h"
#include "render/methods/cull_method.h"
#include "render/query_scene.h"

namespace jalousie::render {

/// Finds on the CPU which objects are seen through portals, and corrects the marks of classify.comp: the frame is then
/// drawn as with frustum culling, and as with frustum culling alone where the eye is in no room. Reads no depth. Where
/// objects move, their transforms are read back and their rooms found anew.
class PortalMethod : public CullMethod {
 public:
  /// @param scene  shared by the modes with the same hierarchy
  PortalMethod(const scene::SceneData& sceneData, std::shared_ptr<QueryScene> scene)
      : sceneData_(sceneData), scene_(std::move(scene)) {}

  void allocate() override;
  void decide(const FrameContext& frame) noexcept override;

 private:
  const scene::SceneData& sceneData_;
  std::shared_ptr<QueryScene> scene_;
  std::optional<culling::PortalCulling> culling_;
  std::uint64_t movement_ = 0;  ///< QueryScene::movement of the objects' rooms
};

}  // namespace jalousie::render
