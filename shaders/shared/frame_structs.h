// What changes every frame: the culling view with its policy, the drawing view, and each object's verdict.
#ifndef JALOUSIE_SHARED_FRAME_STRUCTS_H
#define JALOUSIE_SHARED_FRAME_STRUCTS_H

#include "shared/traits.h"
#include "shared/types.h"

JAL_SHARED_BEGIN

/// Culling camera and policy; std140 uniform block.
struct CullView {
  mat4 clipFromWorld;  // reversed depth: near plane at z = w, far plane at z = 0
  vec4 cameraWorld;    // xyz position, w distance of the near plane
  vec4 forwardWorld;   // xyz unit vector, w 1 for an orthographic camera, else 0
  uint viewportWidth;  // pixels
  uint viewportHeight;
  uint objectCount;
  uint traits;             // kTrait...
  uint analyse;            // 1: LV is wanted even where the LOD rule does not need it
  uint mapLevels;          // levels of the occlusion map and, counted from the screen, of the depth pyramid
  float occluderDistance;  // world units; nearer objects are occluders (thesis 3.2)
  float cullThreshold;     // opacity from which a texel occludes, (0, 1]; 1 is conservative
  uint maxTessellation;    // finest level of the patch path, 1..kMaxTessellationLevel
  float focalPixels;       // viewportHeight / (2 tan(fovY / 2)); orthographic: pixels per world unit
  float tau;               // screen-space error that kTraitFollowsError allows, pixels
  float occluderTau;       // the same for the levels drawn into the occlusion map
  float minPixels;         // objects whose rectangle has a smaller area are not drawn; 0: none
  uint importanceLevels;   // levels of the importance mask; 0: no mask
  uint importanceWidth;    // texels of its finest level
  uint importanceHeight;
  float relax;            // with both kTraitFollowsError and kTraitFollowsLv tau grows to at most tau * (1 + relax)
  uint calm;              // 1: levels follow the budget with hysteresis, one at a time, and are cross-faded
  uint countsValid;       // 1: the pixels of the last frame were counted
  uint measureCover;      // 1: analyse.comp fills ScreenBox.cover, for the views
  float hysteresis;       // calm: a level stays while tau * hysteresis and tau / hysteresis allow it; at least 1
  uint fadeFrames;        // calm: frames of a cross-fade, at most kMaxFadeFrames; 0: levels switch at once
  float maxError;         // kTraitPrice: limit of the largest deviation, pixels; infinite: none
  uint triangleBudget;    // kTraitPrice: triangles of a frame that the price is moved towards; 0: it stays
  uint cellCount;         // cells of the scene; 0: objects are culled and drawn whole
  uint cullCells;         // 1: cells are culled one by one; 0: a cell is drawn where its object is
  float minSpherePixels;  // objects whose bounding sphere has a smaller area on the screen are not drawn; 0: none
  uint reserved0;
};
JAL_ASSERT_SIZE(CullView, 208)

/// What moves the price of a triangle towards a budget from frame to frame (adjust_price.comp).
struct PriceState {
  // Logarithms of the factor of kTrianglePrice. Calm levels: at the fine end of the margin, tau / hysteresis, and at
  // its coarse end; logFine is larger where the margin is narrowed. Else logFine is that of all levels, and logCoarse,
  // never larger, that of finer levels that add at most kBudgetSmallStep of the budget.
  float logFine;
  float logCoarse;
  float gain;       // step of both per unit of lastError
  float lastError;  // logarithm of triangles over budget in the last frame
  // Without calm levels: logFine of the last frame that was above the budget by the price of all levels, and how many
  // frames ago that was.
  float logOver;
  float overAge;
  float reserved0;
  float reserved1;
};
JAL_ASSERT_SIZE(PriceState, 32)

/// One draw list; std140 uniform block, written once.
struct ListView {
  uint phase;  // kMarkEarly or kMarkLate
  uint tileCount;
  uint binCount;
  uint entryCount;       // length of the array that the prefix sum runs over: all counts and a zero
  uint capacity;         // most instances the list holds
  uint commandCapacity;  // commands per list: one per bin, or one per instance
  uint patches;          // 1: the lists of patches exist
  uint reserved0;
};
JAL_ASSERT_SIZE(ListView, 32)

/// One reduction step of the depth pyramid; std140 uniform block, one slice per level, written once.
struct ReduceView {
  uint screenWidth;
  uint screenHeight;
  uint sourceLevel;  // of the source texture
  uint reserved0;
};
JAL_ASSERT_SIZE(ReduceView, 16)

const uint kViewShaded = 0u;
const uint kViewLod = 1u;
const uint kViewLv = 2u;
const uint kViewOcclusion = 3u;
const uint kViewPhase = 4u;      // which phase drew it
const uint kViewCoverage = 5u;   // covered share of the block in front of it
const uint kViewHoles = 6u;      // mean open chord of that block
const uint kViewWireframe = 7u;  // colours of kViewLod under lines
const uint kViewOverdraw = 8u;
const uint kViewGhosts = 9u;  // shaded, with the culled objects over it
const uint kViewLevels = 10u;
const uint kViewDensity = 11u;  // triangles per pixel
const uint kViewCount = 12u;
// Parts of a view, never asked for by themselves.
const uint kViewLines = 100u;
const uint kViewGhost = 101u;

/// Drawing camera; std140 uniform block.
struct DrawView {
  mat4 clipFromWorld;
  vec4 cameraWorld;   // xyz position
  vec4 forwardWorld;  // as in CullView
  vec4 lightWorld;    // xyz unit vector towards the key light
  uint view;          // kView...
  uint patches;       // 1: draws tessellated patches
  uint mapLevel;      // level shown by kViewOcclusion
  float phongAlpha;   // blend towards the projected surface; 3/4 in Boubekeur and Alexa 2008
  uint viewportWidth;
  uint viewportHeight;
  uint maxTessellation;  // as in CullView; scales the colours of kViewLod
  float depthGuard;      // share of its distance by which the occlusion pass moves a surface away from the eye; world
                         // units for an orthographic camera
  uint fadeFrames;       // as in CullView
  uint reserved0;
  uint reserved1;
  uint reserved2;
};
JAL_ASSERT_SIZE(DrawView, 160)

// Verdicts. kVerdictOutside, kVerdictOccluded and kVerdictSmall are not drawn, all others are.
const uint kVerdictOutside = 0u;   // outside the frustum
const uint kVerdictOccluded = 1u;  // occluded: not drawn
const uint kVerdictOccluder = 2u;  // drawn into the occlusion map
const uint kVerdictNear = 3u;      // crosses the near plane: no finite AABR, visible
const uint kVerdictOpen = 4u;      // an occludee with nothing in front of it
const uint kVerdictPartial = 5u;   // partly covered: LV was computed
const uint kVerdictPending = 6u;   // an occludee before the overlap test; also the final state without a map
const uint kVerdictSmall = 7u;     // covers fewer pixels than the contribution threshold
const uint kVerdictStale = 8u;     // drawn in phase 1 because it was visible in the last frame, but occluded
const uint kVerdictCount = 9u;

// Flags of an object: its history, and the phases in which it is drawn.
const uint kMarkVisible = 1u;        // passed the last visibility test
const uint kMarkEarly = 2u;          // first phase: into the occlusion map, or into the frame before the test
const uint kMarkLate = 4u;           // into the frame after the test
const uint kMarkMirrored = 8u;       // the transform has a negative determinant: front faces wind clockwise
const uint kMarkTested = 16u;        // two phases: was in view and tested, so that kMarkVisible is valid
const uint kMarkKnown = 32u;         // was drawn in the last frame too
const uint kMarkSwitched = 64u;      // drawn at another level than in the last frame
const uint kMarkFromCoarser = 128u;  // the level that fades out is the next coarser one, else the next finer
const uint kMarkCounted = 256u;      // has been drawn since the last frame whose pixels were counted
const uint kMarkCalm = 512u;         // the frame was calm, whether it drew the object or not
const uint kMarkRemembered = 1024u;  // the frame before was calm: its level and LV are valid
const uint kMarkMeasured = 2048u;    // the remembered LV comes from a count: the next ones are smoothed
const uint kMarkFadeShift = 12u;  // first bit of the frames that the cross-fade still takes, this one included; 0: none
const uint kMarkFadeMask = 0xf080u;  // kMarkFromCoarser and the frames
const uint kMarkMapLodShift = 16u;   // first bit of the level that is drawn into the occlusion map
const uint kMarkMapLodMask = 0x1f0000u;
const uint kMarkPlaced = 0x200000u;        // scenes with cells: one of the object's cells is on a draw list
const uint kMarkPlacedFading = 0x400000u;  // and one of the level that fades out
const uint kMarkUnseen = 0x800000u;        // the last count found no pixel of it
const uint kMarkLimited = 0x1000000u;      // drawn coarser than the rule wants, to keep the frame within its budget
const uint kMarkNew = 0x2000000u;          // two phases: came into view, and waits for its test
const uint kMarkPhases = 0x7u;             // kMarkVisible, kMarkEarly, kMarkLate
const uint kMarkOfObject = 0x1ff088u;      // what a cell takes from its object: kMarkMirrored, fade, level of the map

// An entry of an instance list: an object, and whether its level fades in or out.
const uint kInstanceFadingIn = 0x40000000u;
const uint kInstanceFadingOut = 0x80000000u;
const uint kInstanceObject = 0x3fffffffu;

/// What the kernels decided for one object.
struct ObjectState {
  uint verdict;       // kVerdict...
  uint lod;           // level of the discrete chain, 0 finest
  uint tessellation;  // level of the patch path, 1..kMaxTessellationLevel
  float lv;           // normalised level of visibility, about [-1.83, 1]; -1: fully visible
};
JAL_ASSERT_SIZE(ObjectState, 16)

/// ScreenBox.cover of an object with nothing in front of it: covered share 0, chord 32768.
const uint kCoverOpen = 0x78000000u;

/// Where an object is on the screen and how large it is there.
struct ScreenBox {
  float minX;  // rectangle clipped to the viewport, pixels, origin at the lower left
  float minY;
  float maxX;
  float maxY;
  float nearestDepth;   // upper bound of the window depth of any of its points; larger is nearer
  float pixelsPerUnit;  // upper bound of pixels per object-space unit of error
  float tau;            // allowed screen-space error, pixels: that of the view, divided by the importance
  uint cover;           // two halves: covered share of the block in front of it, its mean open chord in pixels
};
JAL_ASSERT_SIZE(ScreenBox, 32)

JAL_SHARED_END

#endif
