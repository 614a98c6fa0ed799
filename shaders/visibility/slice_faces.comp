// The commands of solid and double-sided surfaces of a frame drawn in slices, without groups of back faces: as many
// commands for each place as an instance may have ranges, and one for the triangles that are left whole. What is not
// needed is empty (docs/back_faces.md).
//
// One thread: one place; the second half draws the levels that fade out. Reads transforms, order, units, levels, nodes,
// states, marks. Writes commands. Barrier owed: COMMAND, and SHADER_STORAGE for drop_hidden.comp.
// CPU twin: sliceFaces() in src/visibility/face_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/face_structs.h"
#include "shared/query_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
#include "lib/fading.glsl"
#include "lib/bins.glsl"
layout(std140, binding = kBindingFaceView) uniform FaceViewBlock { FaceView faceView; };
layout(std140, binding = kBindingSliceView) uniform SliceViewBlock { SliceView sliceView; };
layout(std430, binding = kBindingTransforms) readonly buffer TransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingFaceOrder) readonly buffer OrderBlock { uint order[]; };
layout(std430, binding = kBindingFaceUnits) readonly buffer UnitBlock { FaceUnit units[]; };
layout(std430, binding = kBindingFaceLods) readonly buffer FaceLodBlock { FaceLod faceLods[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingFaceMarks) readonly buffer MarkBlock { uint marks[]; };
layout(std430, binding = kBindingFaceNodes) readonly buffer NodeBlock { FaceNode nodes[]; };
layout(std430, binding = kBindingCommands) writeonly buffer CommandBlock { DrawCommand commands[]; };
#include "lib/transform.glsl"
#include "lib/faces.glsl"
#include "lib/face_groups.glsl"

/// Where the thread's place writes.
uint place = 0u;
int baseVertex = 0;
uint firstCommand = 0u;
/// Ranges so far; the last one is not written yet.
uint rangeCount = 0u;
uint lastFirst = 0u;
uint lastCount = 0u;

void writeLast() {
  if (rangeCount > 0u)
    commands[firstCommand + rangeCount - 1u] = DrawCommand(lastCount, 1u, lastFirst, baseVertex, place);
}

void addRange(uint first, uint count) {
  if (count == 0u) return;
  if (rangeCount > 0u && (rangeCount == faceView.mostRanges || lastFirst + lastCount == first)) {
    lastCount = first + count - lastFirst;
    return;
  }
  writeLast();
  lastFirst = first;
  lastCount = count;
  ++rangeCount;
}

/// First command of the place in one list.
uint commandOf(uint list) { return (2u * list * sliceView.unitCount + place) * sliceView.faceCommands; }

void clearFrom(uint list, uint used) {
  for (uint i = used; i < sliceView.faceCommands; ++i)
    commands[commandOf(list) + i] = DrawCommand(0u, 0u, 0u, 0, 0u);
}

void main() {
  place = threadNumber();
  if (place >= 2u * sliceView.unitCount) return;
  bool fadesOut = place >= sliceView.unitCount;
  uint id = order[fadesOut ? place - sliceView.unitCount : place];
  uint mark = marks[id];
  if ((mark & kMarkLate) == 0u || (fadesOut && !hasFadingLevel(mark, false))) {
    clearFrom(kListSolid, 0u);
    clearFrom(kListSheet, 0u);
    return;
  }
  uint bin = fadesOut ? fadingBinOfLevel(states[id], mark) : binOfLevel(states[id], mark, false);
  uint list = (bin & 1u) != 0u ? kListSheet : kListSolid;
  FaceUnit unit = units[id];
  FaceLod lod = faceLods[unit.firstLod + (bin >> 1u)];
  baseVertex = lod.baseVertex;
  firstCommand = commandOf(list);
  if (lod.nodeCount > 0u) {
    addGroups(lod, transforms[unit.transform]);
  } else {
    addRange(lod.firstIndex, lod.solidCount);
  }
  writeLast();
  uint sheets = list == kListSheet ? rangeCount : 0u;
  if (lod.sheetCount > 0u)
    commands[commandOf(kListSheet) + sheets++] =
        DrawCommand(lod.sheetCount, 1u, lod.firstIndex + lod.solidCount, baseVertex, place);
  clearFrom(kListSolid, list == kListSolid ? rangeCount : 0u);
  clearFrom(kListSheet, sheets);
}
