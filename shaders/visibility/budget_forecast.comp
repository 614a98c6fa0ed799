// What the objects of this stage would draw at each step of coarser levels (docs/lod_selection.md, "A budget of
// triangles"). Runs only in frames above their budget.
//
// One thread: one object. Reads states, marks, boxes, objects, chains, lods, drawn. Adds to budget.
// Barrier owed: SHADER_STORAGE for budget_limit.comp. CPU twin: src/visibility/triangle_budget.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
#include "lib/budget_objects.glsl"
/// Scenes with cells: triangles that the cells of each object are about to draw, and how many cells have any.
layout(std430, binding = kBindingDrawnOfObjects) readonly buffer DrawnBlock { uint drawn[]; };

shared uint sums[2u * kBudgetSteps];

/// What the cells of an object draw: the same share of the triangles at all levels. Coarser levels have fewer cells,
/// which are larger: one more of them may be visible.
struct DrawnPart {
  float share;
  float extra;  // triangles
};

DrawnPart drawnPart(uint id, DetailInput object, uint mark) {
  if (cullView.cellCount == 0u) return DrawnPart(1.0, 0.0);
  uint whole = trianglesAt(object.chain, object.last) + fadingTriangles(object.chain, object.last.lod, mark);
  float triangles = float(drawn[2u * id]);
  return DrawnPart(triangles / float(max(whole, 1u)), triangles / float(max(drawn[2u * id + 1u], 1u)));
}

void forecast(uint id, uint mark) {
  DetailInput object = detailOf(id, mark);
  DrawnPart part = drawnPart(id, object, mark);
  float scale = 1.0;
  for (uint step = 0u; step < kBudgetSteps; ++step) {
    scale = nextBudgetScale(scale, step);
    ObjectState state = coarserState(object, mark, scale);
    float triangles = float(trianglesAt(object.chain, state));
    float drawnThen = min(part.share * triangles + part.extra, triangles);
    if (state.lod == object.last.lod) drawnThen = part.share * triangles;
    uint sum = uint(ceil(drawnThen));
    atomicAdd(sums[2u * step], sum & 1023u);
    atomicAdd(sums[2u * step + 1u], sum >> 10u);
  }
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint at = lane; at < 2u * kBudgetSteps; at += kObjectGroupSize) sums[at] = 0u;
  barrier();
  uint id = threadNumber();
  if (id < cullView.objectCount && budgetStageOf(marks[id]) == budgetStage()) forecast(id, marks[id]);
  barrier();
  for (uint at = lane; at < 2u * kBudgetSteps; at += kObjectGroupSize)
    if (sums[at] > 0u) atomicAdd(budget[kBudgetForecast + at], sums[at]);
}
