// What one bin of one chain draws. CPU twin: src/visibility/draw_lists_reference.cpp

layout(std430, binding = kBindingCommands) writeonly buffer CommandBlock { DrawCommand commands[]; };

/// A range of indices for each of the three lists of a detail path.
struct Ranges {
  uint firstIndex[3];
  uint count[3];
  int baseVertex;
  uint firstList;  // kListSolid or kListSolidPatch
};

/// Solid triangles of a mirrored object would be culled by their winding, so they go to the sheet list.
Ranges rangesOf(Chain chain, uint bin) {
  uint level = bin >> 1u;
  bool mirrored = (bin & 1u) != 0u;
  bool patches = hasTrait(kTraitPatches);
  Ranges ranges;
  ranges.firstList = patches && level > 0u ? kListSolidPatch : kListSolid;
  bool exists = patches ? level < 2u : level < chain.lodCount;
  Lod lod = lods[patches ? chain.patchLod : chain.firstLod + min(level, chain.lodCount - 1u)];
  uint solid = exists ? lod.solidCount : 0u;
  uint sheet = exists ? lod.sheetCount : 0u;
  ranges.baseVertex = lod.baseVertex;
  ranges.firstIndex[0] = lod.firstIndex;
  ranges.count[0] = mirrored ? 0u : solid;
  ranges.firstIndex[1] = lod.firstIndex + (mirrored ? 0u : solid);
  ranges.count[1] = mirrored ? solid + sheet : sheet;
  ranges.firstIndex[2] = lod.firstIndex + lod.solidCount + lod.sheetCount;
  ranges.count[2] = exists ? lod.blendCount : 0u;
  return ranges;
}
