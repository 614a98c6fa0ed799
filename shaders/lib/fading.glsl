// Cross-fades as the marks of an object hold them. CPU twin: src/visibility/lod_policy.cpp

/// Frames that a cross-fade still takes, this one included; 0: none.
uint fadeFrames(uint mark) { return (mark & kMarkFadeMask) >> kMarkFadeShift; }

/// The level that fades out.
uint fadingLod(uint lod, uint mark) { return (mark & kMarkFromCoarser) != 0u ? lod + 1u : lod - 1u; }
