// Places objects at random in a cube.
#pragma once

#include <glm/glm.hpp>

#include "asset/instancing.h"
#include "core/aabb.h"
#include "core/progress.h"
#include "scatter/options.h"
#include "scatter/source_chain.h"

namespace jalousie::scatter {

/// Side of the cube, world units.
float sideOf(const Layout& layout, const SourceChain& chain);

/// Places layout.count objects. The box's centre of object 0 is at the origin; those of the others are uniform in the
/// cube [-side/2, side/2]^3. The centre of rotation and scale is the box's centre. Deterministic in layout and chain.
asset::Instances placeObjects(const Layout& layout, const SourceChain& chain, Progress& progress);

/// Box of all objects, world space; conservative, as it bounds the rotated boxes.
Aabb boundsOf(const asset::Instances& instances, const Aabb& boxObject);

}  // namespace jalousie::scatter
