// Draw commands of one object: one in each list, with instance count 0 where it has nothing to draw there.
// CPU twin: src/visibility/commands_reference.cpp

void writeCommand(uint list, uint id, uint count, uint firstIndex, int baseVertex) {
  commands[list * cullView.objectCount + id] = DrawCommand(count, count > 0u ? 1u : 0u, firstIndex, baseVertex, id);
}

/// Solid triangles of a mirrored object would be culled by their winding, so they go to the sheet list.
void writeRange(uint solidList, uint sheetList, uint id, Lod lod, bool mirrored, bool drawn) {
  uint solid = drawn && !mirrored ? lod.solidCount : 0u;
  uint sheet = !drawn ? 0u : mirrored ? lod.solidCount + lod.sheetCount : lod.sheetCount;
  writeCommand(solidList, id, solid, lod.firstIndex, lod.baseVertex);
  writeCommand(sheetList, id, sheet, lod.firstIndex + (mirrored ? 0u : lod.solidCount), lod.baseVertex);
}

void writeCommands(uint id, Object object, Chain chain, bool drawn, uint lodIndex, uint tessellation) {
  bool mirrored = (object.flags & kObjectMirrored) != 0u;
  if (cullView.detail == kDetailDiscrete) {
    writeRange(kListSolid, kListSheet, id, lods[chain.firstLod + lodIndex], mirrored, drawn);
    return;
  }
  Lod base = lods[chain.patchLod];
  // Level 1 leaves the triangles as they are: the plain program draws them several times faster.
  writeRange(kListSolid, kListSheet, id, base, mirrored, drawn && tessellation == 1u);
  writeRange(kListSolidPatch, kListSheetPatch, id, base, mirrored, drawn && tessellation > 1u);
}
