// Procedural occluders with small or large holes (thesis Fig. 3.1, 4.11, 4.12).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scatter/box_mesh.h"
#include "scatter/camera_path.h"
#include "scatter/options.h"

namespace jalousie::scatter {

/// Where an occluder stands: a square in the plane z = distance, facing +z, centred on the z axis. World units.
struct OccluderPlace {
  float distance;
  float halfSize;
};

/// Places the occluder between the objects and the first camera position, large enough to occlude all objects from
/// there.
OccluderPlace placeOccluder(const PathSubject& subject);

/// Makes the geometry around the origin, in the square [-halfSize, halfSize]^2 of the plane z = 0.
/// `occluder.cover` is the share of that square that is covered as seen from +z; exact except for foliage, whose leaves
/// fall at random and whose share is at most 0.99.
PlainMesh makeOccluder(const Occluder& occluder, float halfSize, std::uint64_t seed);

/// Makes a slab over the square [-halfSize, halfSize]^2, centred on the plane z = 0.
PlainMesh makeSlab(float halfSize, float thickness);

/// "foliage", "grid", "fence", "plane".
const char* occluderName(OccluderKind kind);

}  // namespace jalousie::scatter
