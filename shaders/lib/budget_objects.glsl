// Levels of one object at the steps of a budget. CPU twin: src/visibility/triangle_budget.cpp
// Include limits, scene and frame structs, groups.glsl before.

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
#include "lib/traits.glsl"
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingBoxes) readonly buffer BoxBlock { ScreenBox boxes[]; };
layout(std430, binding = kBindingMarks) buffer MarkBlock { uint marks[]; };

#include "lib/budget.glsl"
#include "lib/lod.glsl"

DetailInput detailOf(uint id, uint mark) {
  ScreenBox box = boxes[id];
  bool hasRect = box.maxX > box.minX && box.maxY > box.minY;
  float area = hasRect ? (box.maxX - box.minX) * (box.maxY - box.minY)
                       : float(cullView.viewportWidth) * float(cullView.viewportHeight);
  bool seen = (mark & kMarkKnown) != 0u && (mark & kMarkUnseen) == 0u;
  return DetailInput(chains[objects[id].chain], box.pixelsPerUnit, box.tau, area, seen, states[id], box.cover);
}

/// The state with a level that is at least as coarse as the present one. @param scale  of tau and of the limit of the
/// largest deviation
ObjectState coarserState(DetailInput object, uint mark, float scale) {
  bool calm = (mark & kMarkRemembered) != 0u;
  Budget costs = budgetOf(object, object.last.lv, calm, (mark & kMarkCounted) != 0u);
  costs.tau *= scale;
  costs.maxError *= scale;
  ObjectState state = object.last;
  state.lod = max(state.lod, budgetLod(object, costs, 1.0));
  state.tessellation = min(state.tessellation, budgetTessellation(object, costs, 1.0));
  return state;
}
