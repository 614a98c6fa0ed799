// Plain CPU twin of shaders/visibility/classify_cells.comp and analyse_cells.comp: culling of one cell.
#pragma once

#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "visibility/object_decision.h"
#include "visibility/overlap_reference.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// What a frame decides about one cell.
struct CellDecision {
  gpu::ObjectState state{};  ///< that of its object
  gpu::uint marks = 0;       ///< kMark..., of which the phases, kMarkVisible and kMarkTested are the cell's own
};

/// One cell of a frame.
struct CellInput {
  const scene::SceneData& scene;
  const gpu::CullView& view;
  gpu::uint cell;                   ///< index into scene.cells.objects
  const ObjectDecision& object;     ///< what the kernel before has decided about its object
  float rounding = gpu::kRounding;  ///< as of boxOnScreen
};

/// Frustum test and first phase. A cell without triangles at its object's level is in no phase, nor is one outside the
/// frustum. With two phases, a cell of an object that is drawn early is drawn early if it is expected to be visible
/// (isExpectedVisible) or crosses the near plane; other cells wait for the test. Without two phases a cell is in the
/// phases of its object.
/// @param lastMarks  of the cell in the last frame
CellDecision classifyCell(const CellInput& input, gpu::uint lastMarks);

/// Occlusion test: a cell is visible if its object is, and the depth pyramid does not show that the cell is occluded.
/// An occlusion map without depth is asked about whole objects alone.
/// @param cover    as of the test of objects   @param guardPixels  as of testOverlap
/// @param decided  by classifyCell; changed in place
void analyseCell(const CellInput& input, const Cover& cover, float guardPixels, CellDecision& decided);

}  // namespace jalousie::visibility
