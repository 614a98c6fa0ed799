// Keeps one frame within a budget of triangles: what it is about to draw is summed, and levels become coarser where
// that is too much. Plain CPU twin of shaders/visibility/budget_*.comp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "shared/frame_structs.h"
#include "shared/limits.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// kBudgetWanted, kBudgetDrawn and so on.
using BudgetWords = std::array<gpu::uint, gpu::kBudgetWords>;

/// One sum. @param at  index of its first word
float budgetSum(const BudgetWords& words, gpu::uint at);

/// When levels can become coarser: before each of the two phases is drawn.
enum class BudgetStage : gpu::uint { kEarly = 0, kLate = 1 };

/// What a stage reads and changes.
struct BudgetFrame {
  const scene::SceneData& scene;
  const gpu::CullView& view;
  const gpu::PriceState& price;
  std::span<const gpu::ScreenBox> boxes;  ///< [scene.objects.size()]
  std::span<const gpu::uint> cellMarks;   ///< [scene.cells.objects.size()]
  std::span<gpu::ObjectState> states;     ///< [scene.objects.size()]
  std::span<gpu::uint> marks;             ///< likewise
  BudgetWords& words;                     ///< of the frame; the early stage clears all
};

/// Sums what the objects, or the cells, are about to draw. Above the limit of the stage (kBudgetLimitEarly,
/// kBudgetLimitLate), all objects whose level can still change get the levels of the first of kBudgetSteps steps that
/// keeps within it, or of the last one, and fade no more. In scenes with cells, each object is taken to draw the same
/// share of its triangles at every level, and one cell more. The caller then decides about the cells again.
/// @pre frame.view.triangleBudget > 0
void limitTriangles(BudgetFrame& frame, BudgetStage stage);

}  // namespace jalousie::visibility
