// Replaces the commands of single-sided and of double-sided surfaces by one command for each range of an instance, in
// the order of the instances and of the indices (docs/back_faces.md). Commands that are not overwritten are cleared.
//
// One thread: one instance of the list. Reads the work after the prefix sum over its counts. Writes commands, draw
// counts, figures. Atomics only add integers.
// Barrier owed: COMMAND, BUFFER_UPDATE. CPU twin: src/visibility/face_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/face_structs.h"
#include "lib/groups.glsl"
#include "lib/list_buffers.glsl"
#include "lib/offsets.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingFaceView) uniform FaceViewBlock { FaceView faceView; };
layout(std430, binding = kBindingCommands) writeonly buffer CommandBlock { DrawCommand commands[]; };
layout(std430, binding = kBindingDrawCounts) buffer DrawCountBlock { uint drawCounts[]; };
layout(std430, binding = kBindingFaceFigures) buffer FigureBlock { uint figures[]; };
#include "lib/face_work.glsl"

void addFigure(uint figure, uint triangles) {
  if (triangles == 0u) return;
  atomicAdd(figures[figure], triangles & 1023u);
  atomicAdd(figures[figure + 1u], triangles >> 10u);
}

/// @param place  of the first command of each list
void writeInstance(uint instance, uvec2 place) {
  uint head = faceHead(instance);
  uint list = entries[head + kFaceList];
  uint ranges = entries[head + kFaceRanges];
  int baseVertex = int(entries[head + kFaceBaseVertex]);
  uint first = list * listView.commandCapacity + (list == kListSolid ? place.x : place.y);
  for (uint k = 0u; k < ranges; ++k) {
    uint range = head + kFaceHead + 2u * k;
    commands[first + k] = DrawCommand(entries[range + 1u], 1u, entries[range], baseVertex, instance);
  }
  if (entries[head + kFaceSheetCount] > 0u) {
    uint at = kListSheet * listView.commandCapacity + place.y + (list == kListSheet ? ranges : 0u);
    commands[at] =
        DrawCommand(entries[head + kFaceSheetCount], 1u, entries[head + kFaceSheetFirst], baseVertex, instance);
  }
  addFigure(kFaceFigureTested, entries[head + kFaceTested]);
  addFigure(kFaceFigureCulled, entries[head + kFaceCulled]);
  addFigure(kFaceFigureWhole, entries[head + kFaceWhole]);
}

void clearOld(uint instance, uint list, uint written) {
  uint old = entries[faceOldCounts() + list];
  for (uint i = written + instance; i < old; i += listView.capacity)
    commands[list * listView.commandCapacity + i] = DrawCommand(0u, 0u, 0u, 0, 0u);
}

void main() {
  uint instance = threadNumber();
  if (instance >= listView.capacity) return;
  uint sheets = offsetOf(listView.capacity);
  uint total = offsetOf(2u * listView.capacity);
  if (instance < drawCounts[kCountInstances])
    writeInstance(instance, uvec2(offsetOf(instance), offsetOf(listView.capacity + instance) - sheets));
  clearOld(instance, kListSolid, sheets);
  clearOld(instance, kListSheet, total - sheets);
  if (instance > 0u) return;
  drawCounts[kListSolid] = sheets;
  drawCounts[kListSheet] = total - sheets;
}
