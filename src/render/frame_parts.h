// What a FrameRenderer consists of.
#pragma once

#include <array>

#include "core/memory_estimate.h"
#include "gl/capabilities.h"
#include "gl/pass_timer.h"
#include "render/frame_drawing.h"
#include "render/frame_views.h"
#include "render/make_statistics.h"
#include "render/methods/method_table.h"
#include "render/motion_pass.h"
#include "scene/scene_data.h"
#include "visibility/statistics_pass.h"

namespace jalousie::render {

/// What queries took in a frame that the statistics may still ask for.
struct QueryRecord {
  std::uint64_t frame = 0;
  culling::QueryFigures figures;
};

/// Members refer to each other through the context, so the parts stay where they were made.
struct FrameParts {
  FrameParts(const scene::SceneData& sceneData, std::uint32_t width, std::uint32_t height,
             const RendererOptions& options, const gl::ShaderLibrary& shaders);

  MemoryEstimate needs;  ///< buffers and targets
  const scene::SceneData& scene;
  MemoryLimit memory;
  gl::Capabilities capabilities;
  gpu::uint tessellationLimit;
  FinestTriangles finestTriangles;
  SceneBuffers buffers;
  std::optional<MotionPass> motion;  ///< if something moves
  Targets targets;
  visibility::OcclusionMapPass map;
  visibility::DepthPyramidPass pyramid;
  visibility::ObjectStore objects;
  visibility::VisibilityPass visibility;
  visibility::BudgetPass budget;
  visibility::DrawListPass lists;
  visibility::DrawList early;
  visibility::DrawList late;
  std::optional<FaceParts> faces;  ///< if the scene has groups of triangles
  visibility::StatisticsPass statistics;
  DrawPass draw;
  gl::PassTimer timer;
  gpu::CullView cullView{};
  gpu::DrawView drawView{};
  CullMode cullMode = CullMode::kFull;          ///< of the last frame
  culling::QueryOptions queryOptions;           ///< of the last frame
  culling::OccluderOptions occluderOptions;     ///< of the last frame
  culling::QueryFigures queryFigures;           ///< of the last frame
  FaceCulling faceCulling = FaceCulling::kOff;  ///< of the last frame
  bool counting = false;                        ///< this frame's visible pixels are counted
  std::uint32_t countAge = kCountInterval;      ///< frames since they last were
  std::array<QueryRecord, 4> queryRecords;      ///< by frame
  MethodTable methods;
  FrameContext context;
  FrameDrawing drawing;

  void setViews(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera);
  /// Whether this frame's visible pixels are counted: one frame in kCountInterval, where LV needs them.
  bool countsNow(const FrameOptions& options);
  std::optional<FrameStatistics> statisticsOf(const std::optional<visibility::FrameRecord>& record) const;
};

}  // namespace jalousie::render
