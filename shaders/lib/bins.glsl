// The bin of an object or cell: its level, and whether its triangles go to the sheet list. Two bins a level.

/// @param forMap  of the level that is drawn into the occlusion map, which has its own budget
uint binOfLevel(ObjectState state, uint mark, bool forMap) {
  uint level = state.lod;
  bool sheet = (mark & kMarkMirrored) != 0u;
  if (forMap && !hasTrait(kTraitPatches)) {
    level = (mark & kMarkMapLodMask) >> kMarkMapLodShift;
  } else if (hasTrait(kTraitPatches)) {
    level = state.tessellation > 1u ? 1u : 0u;  // level 1 leaves the triangles as they are: the plain program
  } else {
    sheet = sheet || fadeFrames(mark) > 0u;
  }
  return 2u * level + (sheet ? 1u : 0u);
}

/// Whether a second level is drawn over the first.
bool hasFadingLevel(uint mark, bool forMap) { return fadeFrames(mark) > 0u && !forMap && !hasTrait(kTraitPatches); }

/// Bin of the level that fades out.
uint fadingBinOfLevel(ObjectState state, uint mark) { return 2u * fadingLod(state.lod, mark) + 1u; }
