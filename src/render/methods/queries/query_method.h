// The modes that ask hardware occlusion queries while they draw (docs/occlusion_queries.md).
#pragma once

#include <memory>

#include "culling/schedule_table.h"
#include "render/methods/cull_method.h"
#include "render/query_scene.h"

namespace jalousie::render {

/// Draws the frame in slices, in the order that a schedule of src/culling decides. Opaque surfaces only: blended ones
/// are drawn at the end, of all objects that were found visible.
class QueryMethod : public CullMethod {
 public:
  /// @param scene  shared by the modes with the same hierarchy
  QueryMethod(std::shared_ptr<QueryScene> scene, culling::QueryMethod method,
              DeferredDrawing deferred = DeferredDrawing::kConditional)
      : scene_(std::move(scene)), method_(method), deferred_(deferred) {}

  void allocate() override;
  void forget() override;
  void decide(const FrameContext& frame) noexcept override;

 private:
  void run(const FrameContext& frame);

  std::shared_ptr<QueryScene> scene_;
  culling::QueryMethod method_;
  DeferredDrawing deferred_;
  std::unique_ptr<culling::QuerySchedule> schedule_;
  std::uint64_t version_ = 0;  ///< QueryScene::version of the schedule's history
};

}  // namespace jalousie::render
