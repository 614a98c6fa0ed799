// Decides whether levels have to become coarser in this frame: the workgroups of the kernels that do it, or none
// (docs/lod_selection.md, "A budget of triangles").
//
// One thread. Reads and writes budget. Barriers owed: SHADER_STORAGE and COMMAND for budget_forecast.comp and what
// follows. CPU twin: src/visibility/triangle_budget.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"

layout(local_size_x = 1) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
#include "lib/traits.glsl"
#include "lib/budget.glsl"

/// Workgroups of a kernel with one thread each, in rows as dispatchGroups (visibility/dispatch.h) makes them.
void writeGroups(uint at, uint threads) {
  uint groups = (threads + kObjectGroupSize - 1u) / kObjectGroupSize;
  uint width = min(groups, 65535u);
  budget[at] = width;
  budget[at + 1u] = groups > 0u ? (groups - 1u) / width + 1u : 0u;
  budget[at + 2u] = 1u;
}

void main() {
  bool over = budgetFixed() + budgetSum(kBudgetDrawn + 2u * budgetStage()) > budgetLimit();
  writeGroups(kBudgetObjectGroups, over ? cullView.objectCount : 0u);
  writeGroups(kBudgetCellGroups, over ? cullView.cellCount : 0u);
}
