// Random placement of objects in a cube.
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

/// Places layout.count objects: object 0 with its box's centre at the origin, the others with theirs uniform in the
/// cube
/// [-side/2, side/2]^3. The centre of rotation and scale is the box's centre. Same layout and chain, same numbers.
asset::Instances placeObjects(const Layout& layout, const SourceChain& chain, Progress& progress);

/// Box of all objects, world space; conservative by the rotated boxes.
Aabb boundsOf(const asset::Instances& instances, const Aabb& boxObject);

}  // namespace jalousie::scatter
