// What changes every frame: the culling view with its policy, the drawing view, and each object's verdict.
#ifndef JALOUSIE_SHARED_FRAME_STRUCTS_H
#define JALOUSIE_SHARED_FRAME_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

const uint kCullNone = 0u;     // every object is drawn
const uint kCullFrustum = 1u;
const uint kCullHom = 2u;      // hierarchical occlusion map (Zhang 1997; thesis ch. 3)

const uint kLodFinest = 0u;
const uint kLodLinear = 1u;    // thesis 4.1.3: LV mapped linearly onto the levels

const uint kDetailDiscrete = 0u;
const uint kDetailTessellation = 1u;

/// Culling camera and policy; std140 uniform block.
struct CullView {
  mat4 clipFromWorld;      // reversed depth: near plane at z = w, far plane at z = 0
  vec4 cameraWorld;        // xyz position
  uint viewportWidth;      // pixels
  uint viewportHeight;
  uint objectCount;
  uint cullMode;           // kCull...
  uint lodRule;            // kLod...
  uint detail;             // kDetail...
  uint analyse;            // 1: LV is wanted even where the LOD rule does not need it
  uint mapLevels;          // levels of the occlusion map
  float occluderDistance;  // world units; nearer objects are occluders (thesis 3.2)
  float cullThreshold;     // opacity from which a texel hides, (0, 1]; 1 is conservative
  uint maxTessellation;    // finest level of the patch path, 1..kMaxTessellationLevel
  uint reserved0;
};
JAL_ASSERT_SIZE(CullView, 128)

const uint kViewShaded = 0u;
const uint kViewLod = 1u;
const uint kViewLv = 2u;
const uint kViewOcclusion = 3u;

/// Drawing camera; std140 uniform block.
struct DrawView {
  mat4 clipFromWorld;
  vec4 cameraWorld;        // xyz position
  vec4 lightWorld;         // xyz unit vector towards the key light
  uint view;               // kView...
  uint detail;             // kDetail...
  uint mapLevel;           // level shown by kViewOcclusion
  float phongAlpha;        // blend towards the projected surface; 3/4 in Boubekeur and Alexa 2008
  uint viewportWidth;
  uint viewportHeight;
  uint maxTessellation;    // as in CullView; scales the colours of kViewLod
  uint reserved0;
};
JAL_ASSERT_SIZE(DrawView, 128)

// Verdicts. Order matters: kVerdictOutside and kVerdictOccluded are the only ones that are not drawn.
const uint kVerdictOutside = 0u;    // outside the frustum
const uint kVerdictOccluded = 1u;   // hidden by the occlusion map
const uint kVerdictOccluder = 2u;   // near enough to be drawn into the map
const uint kVerdictNear = 3u;       // crosses the near plane: no finite AABR, visible
const uint kVerdictOpen = 4u;       // an occludee with nothing in front of it
const uint kVerdictPartial = 5u;    // partly covered: LV was computed
const uint kVerdictPending = 6u;    // an occludee before the overlap test; also the final state without a map
const uint kVerdictCount = 7u;

/// What the kernels decided for one object.
struct ObjectState {
  uint verdict;            // kVerdict...
  uint lod;                // level of the discrete chain, 0 finest
  uint tessellation;       // level of the patch path, 1..kMaxTessellationLevel
  float lv;                // normalised level of visibility, about [-1.83, 1]; -1 for what is open
};
JAL_ASSERT_SIZE(ObjectState, 16)

/// Screen rectangle of an occludee, clipped to the viewport, in pixels, origin at the lower left.
struct ScreenRect {
  float minX;
  float minY;
  float maxX;
  float maxY;
};
JAL_ASSERT_SIZE(ScreenRect, 16)

JAL_SHARED_END

#endif
