// How far a level lies from the original surface.
#pragma once

namespace jalousie::bake {

/// Distances from the points of one surface to another, object-space length.
struct Distances {
  double max = 0.0;
  double mean = 0.0;
};

/// Deviation of an attribute over a surface.
struct Spread {
  double mean = 0.0;
  double p95 = 0.0;  ///< 95th percentile by area
};

/// Deviation of a level from the original, measured in both directions.
struct Deviation {
  Distances toOriginal;    ///< from the level's points to the original
  Distances fromOriginal;  ///< from the original's points to the level
  Distances twoSided;      ///< the larger maximum; the mean of the two means
  Spread normalDegrees;    ///< angle between shading normals, over the points of both surfaces
  Spread uv;               ///< distance in TEXCOORD_0, over points whose nearest point lies in the same chart
};

}  // namespace jalousie::bake
