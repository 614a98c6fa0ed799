// Makes the levels of this stage's objects coarser by the first step that keeps the frame within its limit, or by the
// last one (docs/lod_selection.md, "A budget of triangles"). Runs only in frames above their budget.
//
// One thread: one object. Reads budget, boxes, objects, chains, lods. Writes states, marks.
// Barrier owed: SHADER_STORAGE for the kernels of cells and bin_objects.comp.
// CPU twin: src/visibility/triangle_budget.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
#include "lib/budget_objects.glsl"

float scaleWithinLimit() {
  float scale = 1.0;
  for (uint step = 0u; step < kBudgetSteps; ++step) {
    scale = nextBudgetScale(scale, step);
    if (budgetFixed() + budgetSum(kBudgetForecast + 2u * step) <= budgetLimit()) break;
  }
  return scale;
}

void main() {
  uint id = threadNumber();
  if (id >= cullView.objectCount) return;
  uint mark = marks[id];
  if (budgetStageOf(mark) != budgetStage()) return;
  DetailInput object = detailOf(id, mark);
  ObjectState state = coarserState(object, mark, scaleWithinLimit());
  bool same = hasTrait(kTraitPatches) ? state.tessellation == object.last.tessellation : state.lod == object.last.lod;
  mark &= ~kMarkFadeMask;  // a second level would count, too
  if (!same) mark |= (mark & kMarkKnown) != 0u ? kMarkSwitched | kMarkLimited : kMarkLimited;
  states[id] = state;
  marks[id] = mark;
}
