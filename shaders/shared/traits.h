// Traits of a frame's policy: what the culling mode, the level rule, the visibility measure and the detail path ask of
// the kernels. Kernels test these bits and know no mode by its number. The tables in src/policy say who has which.
#ifndef JALOUSIE_SHARED_TRAITS_H
#define JALOUSIE_SHARED_TRAITS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

// Culling mode.
const uint kTraitCulls = 1u;           // objects outside the frustum or below minPixels are not drawn
const uint kTraitTestsOcclusion = 2u;  // analyse.comp tests what classify.comp leaves pending
const uint kTraitUsesMap = 4u;         // occluders are drawn into an occlusion map before the test
const uint kTraitUsesDepth = 8u;       // a texel occludes only what lies behind its farthest depth
const uint kTraitTwoPhases = 16u;      // what was visible in the last frame is drawn before the test

// Level rule. With the first two bits, the level of visibility relaxes the error budget.
const uint kTraitFollowsError = 256u;  // levels follow the screen-space error
const uint kTraitFollowsLv = 512u;     // levels follow the level of visibility
const uint kTraitPrice = 1024u;        // with both: levels have the least sum of visible error and priced triangles
const uint kTraitMasksError = 2048u;   // with the first: errors count less behind small holes
const uint kTraitCoverage = 4096u;     // with the first: the share of the screen decides, scaled by tau, not the error

// Visibility measure; none of them: LV stays at its least value.
const uint kTraitLvThesis = 65536u;     // four DCT coefficients (thesis 3.5)
const uint kTraitLvSpectral = 131072u;  // share of high frequencies
const uint kTraitLvChord = 262144u;     // mean open chord
const uint kTraitLvCoverage = 524288u;  // covered share alone
const uint kTraitLvPixels = 1048576u;   // visible pixels, counted; the covered share where there is no count yet

// Detail path.
const uint kTraitPatches = 16777216u;  // Phong-tessellated patches instead of the discrete LOD chain

JAL_SHARED_END

#endif
