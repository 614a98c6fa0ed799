// Colours of the debug views and of their legends, linear RGB; the fourth component is 1.
#ifndef JALOUSIE_SHARED_PALETTE_H
#define JALOUSIE_SHARED_PALETTE_H

#include "shared/types.h"

JAL_SHARED_BEGIN

// Levels of detail (thesis Fig. 4.3). Levels between the finest and the coarsest are mixed.
const vec4 kColorFinestOccluder = vec4(0.55, 0.02, 0.02, 1.0);
const vec4 kColorCoarsestOccluder = vec4(1.0, 0.45, 0.40, 1.0);
const vec4 kColorFinestLod = vec4(0.005, 0.02, 0.35, 1.0);
const vec4 kColorCoarsestLod = vec4(0.55, 0.85, 1.0, 1.0);

// One colour per level, LOD 0 first; level kLevelColors has the first one again. Neighbours differ in hue and in
// lightness.
const uint kLevelColors = 12u;
const vec4 kColorLevel0 = vec4(0.03, 0.12, 0.62, 1.0);   // blue
const vec4 kColorLevel1 = vec4(0.95, 0.38, 0.02, 1.0);   // orange
const vec4 kColorLevel2 = vec4(0.02, 0.30, 0.10, 1.0);   // green
const vec4 kColorLevel3 = vec4(0.95, 0.78, 0.08, 1.0);   // yellow
const vec4 kColorLevel4 = vec4(0.42, 0.03, 0.42, 1.0);   // purple
const vec4 kColorLevel5 = vec4(0.20, 0.75, 0.90, 1.0);   // sky
const vec4 kColorLevel6 = vec4(0.60, 0.02, 0.04, 1.0);   // red
const vec4 kColorLevel7 = vec4(0.50, 0.90, 0.40, 1.0);   // light green
const vec4 kColorLevel8 = vec4(0.20, 0.08, 0.02, 1.0);   // brown
const vec4 kColorLevel9 = vec4(0.95, 0.50, 0.72, 1.0);   // pink
const vec4 kColorLevel10 = vec4(0.02, 0.20, 0.26, 1.0);  // teal
const vec4 kColorLevel11 = vec4(0.80, 0.80, 0.80, 1.0);  // white

// Phase in which an object was drawn.
const vec4 kColorPhase1 = vec4(0.32, 0.36, 0.40, 1.0);
const vec4 kColorPhase2 = vec4(0.95, 0.38, 0.02, 1.0);
const vec4 kColorStale = vec4(0.75, 0.03, 0.03, 1.0);  // drawn in phase 1 although occluded

// Culled objects, by the reason.
const vec4 kColorGhostOccluded = vec4(0.90, 0.05, 0.45, 1.0);
const vec4 kColorGhostSmall = vec4(0.90, 0.70, 0.05, 1.0);
const vec4 kColorGhostOutside = vec4(0.25, 0.40, 0.65, 1.0);

// Points and lines, which belong to no object.
const vec4 kColorLoose = vec4(0.35, 0.35, 0.35, 1.0);

// Bounding rectangles, by the verdict.
const vec4 kColorBoxOccluded = vec4(0.80, 0.03, 0.03, 1.0);
const vec4 kColorBoxPartial = vec4(0.90, 0.60, 0.02, 1.0);
const vec4 kColorBoxOccluder = vec4(0.9, 0.9, 0.9, 1.0);
const vec4 kColorBoxVisible = vec4(0.05, 0.65, 0.12, 1.0);

// Heat scale: dark blue, green, yellow. A piecewise linear fit of a perceptually uniform ramp.
const vec4 kColorHeatLow = vec4(0.06, 0.01, 0.14, 1.0);
const vec4 kColorHeatMiddle = vec4(0.02, 0.27, 0.26, 1.0);
const vec4 kColorHeatHigh = vec4(0.98, 0.80, 0.05, 1.0);

JAL_SHARED_END

#endif
