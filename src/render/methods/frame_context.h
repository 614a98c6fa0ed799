// What a culling method works with while it decides one frame.
#pragma once

#include "culling/occluder_options.h"
#include "culling/query_figures.h"
#include "culling/query_options.h"
#include "gl/pass_timer.h"
#include "policy/cull_mode.h"
#include "policy/face_culling.h"
#include "render/draw_pass.h"
#include "render/scene_buffers.h"
#include "render/slice_pass.h"
#include "render/targets.h"
#include "scene/face_tables.h"
#include "visibility/budget_pass.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/face_pass.h"
#include "visibility/occlusion_map_pass.h"
#include "visibility/visibility_pass.h"

namespace jalousie::render {

/// What culls groups of back faces.
struct FaceParts {
  FaceParts(const scene::FaceTables& tables, const visibility::DrawList& earlyList,
            const visibility::DrawList& lateList, const gl::ShaderLibrary& shaders)
      : pass(tables, shaders),
        early(earlyList),
        late(lateList),
        rangesInSlices(sliceRanges(tables.mostGroups, static_cast<std::uint32_t>(tables.units.size()))) {}

  visibility::FacePass pass;
  visibility::FaceWork early;
  visibility::FaceWork late;
  std::uint32_t rangesInSlices;  ///< of an instance where the frame is drawn in slices
};

/// Borrows everything from the renderer, for as long as the renderer lives. Nothing here allocates.
/// A method reads the views, fills lists and draws; what it decides ends in the objects' flags (kMark...).
struct FrameContext {
  const gpu::CullView& cullView;  ///< of the present frame
  const gpu::DrawView& drawView;
  const bool& counting;  ///< the visible pixels of this frame are counted; it is drawn into Targets::counted
  gl::PassTimer& timer;
  SceneBuffers& scene;
  visibility::VisibilityPass& visibility;
  visibility::BudgetPass& budget;
  visibility::DrawListPass& lists;
  visibility::DrawList& early;  ///< objects flagged kMarkEarly
  visibility::DrawList& late;   ///< objects flagged kMarkLate
  DrawPass& draw;
  const Targets& targets;
  visibility::OcclusionMapPass& map;                ///< shared by the methods that use a map
  visibility::DepthPyramidPass& pyramid;            ///< shared by the methods that use depth
  const culling::QueryOptions& queryOptions;        ///< of the present frame
  const culling::OccluderOptions& occluderOptions;  ///< of the present frame
  culling::QueryFigures& queryFigures;              ///< the method of the present frame writes them
  FaceParts* faces;                                 ///< null if the scene has no groups of triangles
  const FaceCulling& faceCulling;                   ///< of the present frame
  const CullMode& cullMode;                         ///< of the present frame

  /// Fills a list with the objects that the flags put on it, without their back faces where groups of them are culled.
  void buildList(visibility::DrawList& list, const char* pass) const;
  /// What culls the back faces of a frame drawn in slices.
  SliceFaces sliceFaces() const;
  /// Where the frame has a budget of triangles: makes levels coarser if the next phase would exceed it.
  /// @param list  of the next phase, not built yet
  void limitTriangles(const visibility::DrawList& list) const;
  /// Draws from the culling camera. @param depthGuard  as in gpu::DrawView
  void setCullingCamera(float depthGuard = 0.0F) const;
  /// Draws one part of a list into the bound framebuffer.
  void drawList(DrawKind kind, DrawPart part, const visibility::DrawList& list) const;
  /// Builds the depth pyramid of the frame's depth.
  void buildPyramid(visibility::DepthSource source) const;
  /// Runs the occlusion test and LV of the pending objects against what the mode's traits name.
  void analyse() const;

 private:
  /// The occlusion map has other pixels than the frame, and patches have no groups: their lists stay whole.
  bool cullsFaces(const visibility::DrawList& list) const;
  bool cullsFaces() const;
};

}  // namespace jalousie::render
