// Adds up the triangles that the objects, or the cells, of a frame are about to draw (docs/lod_selection.md, "A budget
// of triangles"). Sums of whole numbers do not depend on their order.
//
// JAL_CELLS: one thread: one cell. Also sums per object. Otherwise one thread: one object.
// Reads states, marks, objects or cells, chains, lods, and cellMarks. Adds to budget and drawn, which the pass cleared.
// Barrier owed: SHADER_STORAGE for budget_plan.comp. CPU twin: src/visibility/triangle_budget.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
#include "lib/traits.glsl"
#ifdef JAL_CELLS
layout(std430, binding = kBindingObjects) readonly buffer CellBlock { Object cells[]; };
layout(std430, binding = kBindingCellMarks) readonly buffer CellMarkBlock { uint cellMarks[]; };
layout(std430, binding = kBindingDrawnOfCells) buffer DrawnBlock { uint drawn[]; };
#else
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
#endif
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };

#include "lib/budget.glsl"
#include "lib/lod.glsl"

/// Words of the two sums that each stage has.
shared uint wanted[2u * kBudgetStages];
shared uint all[2u * kBudgetStages];
shared uint reserved[2];

/// What came into view may be drawn late, at its coarsest level at least.
void reserve(uint id, Chain chain) {
  if (budgetStage() != 0u || (marks[id] & kMarkNew) == 0u) return;
  ObjectState coarsest = ObjectState(0u, chain.lodCount - 1u, 1u, 0.0);
  uint triangles = trianglesAt(chain, coarsest);
  atomicAdd(reserved[0], triangles & 1023u);
  atomicAdd(reserved[1], triangles >> 10u);
}

/// @param id  of the object   @param chain  of the object or cell   @param phase  stage of its phase, which is later
/// than that of the object for some cells of an object that the first phase draws
void addTriangles(uint id, Chain chain, uint phase) {
  uint stage = budgetStageOf(marks[id]);
  if (stage == kBudgetStages || phase == kBudgetStages) return;
  ObjectState state = states[id];
  uint settled = trianglesAt(chain, state);
  uint fading = fadingTriangles(chain, state.lod, marks[id]);
  uint sum = settled + fading;
  atomicAdd(wanted[2u * phase], settled & 1023u);
  atomicAdd(wanted[2u * phase + 1u], settled >> 10u);
  atomicAdd(all[2u * stage], sum & 1023u);
  atomicAdd(all[2u * stage + 1u], sum >> 10u);
#ifdef JAL_CELLS
  if (settled + fading == 0u) return;
  atomicAdd(drawn[2u * id], settled + fading);
  atomicAdd(drawn[2u * id + 1u], 1u);
#endif
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane < 2u * kBudgetStages) wanted[lane] = all[lane] = 0u;
  if (lane < 2u) reserved[lane] = 0u;
  barrier();
  uint thread = threadNumber();
#ifdef JAL_CELLS
  if (thread < cullView.cellCount) {
    Object cell = cells[thread];
    addTriangles(cell.object, chains[cell.chain], budgetStageOf(cellMarks[thread]));
    reserve(cell.object, chains[cell.chain]);
  }
#else
  if (thread < cullView.objectCount) {
    addTriangles(thread, chains[objects[thread].chain], budgetStageOf(marks[thread]));
    reserve(thread, chains[objects[thread].chain]);
  }
#endif
  barrier();
  if (lane < 2u && reserved[lane] > 0u) atomicAdd(budget[kBudgetReserve + lane], reserved[lane]);
  if (lane < 2u * kBudgetStages) {
    if (all[lane] > 0u) atomicAdd(budget[kBudgetDrawn + lane], all[lane]);
    // What the first phase wants was added before its levels became coarser.
    if (wanted[lane] > 0u && lane / 2u == budgetStage()) atomicAdd(budget[kBudgetWanted + lane], wanted[lane]);
  }
}
