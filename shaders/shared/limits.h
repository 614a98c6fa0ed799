// Limits, workgroup sizes and bindings, once for C++ and GLSL.
#ifndef JALOUSIE_SHARED_LIMITS_H
#define JALOUSIE_SHARED_LIMITS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// Threads per workgroup of the kernels that handle one object per thread.
const uint kObjectGroupSize = 64u;
/// Side of the square workgroup of the kernels that handle one texel per thread.
const uint kTexelGroupSide = 8u;

/// The analysed block lies this many pyramid levels below the level at which the AABR is about one texel (thesis 3.5).
const uint kBlockLevels = 4u;
/// Longest side of the analysed block in texels: 2^kBlockLevels.
const uint kMaxBlockSide = 16u;
/// A block whose longer side is shorter than this has no meaningful spectrum: its mean alone counts.
const uint kMinSpectrumSide = 4u;
/// The overlap test looks at most this many levels below LOM (thesis 3.4).
const uint kMaxDescent = 2u;

/// Finest tessellation level (thesis 4.1.3). A patch then has 3 * 20^2 / 2 = 600 triangles.
const uint kMaxTessellationLevel = 20u;
/// Most levels one chain may have. State and colour scales assume no more.
const uint kMaxLods = 32u;

// Draw lists: one command per object in each, one multi-draw-indirect call per list.
const uint kListSolid = 0u;       // single-sided opaque triangles, back faces culled by the rasteriser
const uint kListSheet = 1u;       // double-sided or masked triangles, and mirrored objects: facing decided per fragment
const uint kListSolidPatch = 2u;  // the same two, drawn as tessellated patches
const uint kListSheetPatch = 3u;
const uint kListCount = 4u;

// Shader storage bindings.
const uint kBindingObjects = 0u;
const uint kBindingChains = 1u;
const uint kBindingLods = 2u;
const uint kBindingStates = 3u;
const uint kBindingRects = 4u;
const uint kBindingCommands = 5u;
const uint kBindingMaterials = 6u;
const uint kBindingCosines = 7u;

// Uniform buffer bindings.
const uint kBindingCullView = 0u;
const uint kBindingDrawView = 1u;

// Texture and image units.
const uint kUnitBaseColor = 0u;
const uint kUnitOcclusionMap = 1u;
const uint kImageSource = 0u;
const uint kImageTarget = 1u;

// Vertex attribute locations.
const uint kAttributePosition = 0u;
const uint kAttributeNormal = 1u;
const uint kAttributeUv = 2u;
const uint kAttributeColor = 3u;
const uint kAttributeMaterial = 4u;
const uint kAttributeObject = 5u;

JAL_SHARED_END

#endif
