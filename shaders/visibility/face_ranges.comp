// The ranges of indices that each instance of a list draws: those of the groups of triangles that are not all back
// faces (docs/back_faces.md). Neighbouring ranges are one; where an instance would have more than FaceView.mostRanges,
// the last one goes on to the end, over back faces as well.
//
// One thread: one instance of the list. Reads transforms, slots, instances, draw counts, units, levels, nodes. Writes
// the work: numbers of commands, heads and ranges.
// Barrier owed: SHADER_STORAGE for scan.comp and face_commands.comp. CPU twin: src/visibility/face_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/face_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
layout(std140, binding = kBindingFaceView) uniform FaceViewBlock { FaceView faceView; };
layout(std430, binding = kBindingTransforms) readonly buffer TransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingSlots) readonly buffer SlotBlock { uint slots[]; };
layout(std430, binding = kBindingFaceUnits) readonly buffer UnitBlock { FaceUnit units[]; };
layout(std430, binding = kBindingFaceLods) readonly buffer FaceLodBlock { FaceLod faceLods[]; };
layout(std430, binding = kBindingInstances) readonly buffer InstanceBlock { uint instances[]; };
layout(std430, binding = kBindingFaceCounts) readonly buffer DrawCountBlock { uint drawCounts[]; };
layout(std430, binding = kBindingFaceNodes) readonly buffer NodeBlock { FaceNode nodes[]; };
layout(std430, binding = kBindingFaceWork) buffer WorkBlock { uint work[]; };
#include "lib/transform.glsl"
#include "lib/faces.glsl"
#include "lib/face_groups.glsl"
#include "lib/face_work.glsl"

/// Ranges of the thread's instance.
uint firstRange = 0u;
uint rangeCount = 0u;

void addRange(uint first, uint count) {
  if (count == 0u) return;
  uint last = firstRange + 2u * rangeCount - 2u;
  if (rangeCount > 0u && (rangeCount == faceView.mostRanges || work[last] + work[last + 1u] == first)) {
    work[last + 1u] = first + count - work[last];
    return;
  }
  work[last + 2u] = first;
  work[last + 3u] = count;
  ++rangeCount;
}

uint trianglesInRanges() {
  uint indices = 0u;
  for (uint k = 0u; k < rangeCount; ++k) indices += work[firstRange + 2u * k + 1u];
  return indices / 3u;
}

void writeInstance(uint instance) {
  uint entry = instances[instance];
  uint id = entry & kInstanceObject;
  uint bin = slots[2u * id + ((entry & kInstanceFadingOut) != 0u ? 1u : 0u)] & ((1u << kSlotBinBits) - 1u);
  FaceUnit unit = units[id];
  FaceLod lod = faceLods[unit.firstLod + (bin >> 1u)];
  uint head = faceHead(instance);
  firstRange = head + kFaceHead;
  rangeCount = 0u;
  bool known = lod.nodeCount > 0u;
  if (known) {
    addGroups(lod, transforms[unit.transform]);
  } else {
    addRange(lod.firstIndex, lod.solidCount);
  }
  uint list = (bin & 1u) != 0u ? kListSheet : kListSolid;
  work[head + kFaceList] = list;
  work[head + kFaceRanges] = rangeCount;
  work[head + kFaceBaseVertex] = uint(lod.baseVertex);
  work[head + kFaceSheetFirst] = lod.firstIndex + lod.solidCount;
  work[head + kFaceSheetCount] = lod.sheetCount;
  work[head + kFaceTested] = known ? lod.solidCount / 3u : 0u;
  work[head + kFaceCulled] = known ? lod.solidCount / 3u - trianglesInRanges() : 0u;
  work[head + kFaceWhole] = (lod.sheetCount + (known ? 0u : lod.solidCount)) / 3u;
  work[instance] = list == kListSolid ? rangeCount : 0u;
  work[listView.capacity + instance] = (list == kListSheet ? rangeCount : 0u) + (lod.sheetCount > 0u ? 1u : 0u);
}

void main() {
  uint instance = threadNumber();
  if (instance >= listView.capacity) return;
  if (instance == 0u) {
    work[2u * listView.capacity] = 0u;
    work[faceOldCounts()] = drawCounts[kListSolid];
    work[faceOldCounts() + 1u] = drawCounts[kListSheet];
  }
  if (instance < drawCounts[kCountInstances]) {
    writeInstance(instance);
  } else {
    work[instance] = work[listView.capacity + instance] = 0u;
  }
}
