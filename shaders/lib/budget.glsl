// Triangles of a frame within a budget: sums, and the steps by which levels become coarser (docs/lod_selection.md).
// Include blocks of CullView and ListView before. CPU twin: src/visibility/triangle_budget.cpp

layout(std430, binding = kBindingBudget) buffer BudgetBlock { uint budget[]; };

/// One sum: bits 0 to 9 of all terms, and the other bits.
float budgetSum(uint at) { return float(budget[at + 1u]) * 1024.0 + float(budget[at]); }

/// 0: before the first phase is drawn; 1: before the second.
uint budgetStage() { return listView.phase == kMarkEarly ? 0u : 1u; }

/// Triangles from which on levels become coarser in this frame.
float budgetLimit() {
  return float(cullView.triangleBudget) * (budgetStage() == 0u ? kBudgetLimitEarly : kBudgetLimitLate);
}

/// Triangles of the frame that this stage cannot change: in the late stage those of the early one, in the early stage
/// what is reserved for the late one.
float budgetFixed() {
  return budgetStage() == 0u ? min(budgetSum(kBudgetReserve), kMostReserved * float(cullView.triangleBudget))
                             : budgetSum(kBudgetDrawn);
}

/// Stage in which an object's level can still be changed; kBudgetStages: it is not drawn.
uint budgetStageOf(uint mark) {
  if (hasTrait(kTraitTwoPhases) && (mark & kMarkEarly) != 0u) return 0u;
  return (mark & kMarkLate) != 0u ? 1u : kBudgetStages;
}

/// Factor of tau and of the limit of the largest deviation after one more step; the last one leaves the coarsest level.
float nextBudgetScale(float scale, uint step) {
  return step + 1u == kBudgetSteps ? kBudgetLastScale : scale * kBudgetStepScale;
}
