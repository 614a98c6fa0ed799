// Places objects at random in a cube or on the ground.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "asset/instancing.h"
#include "core/aabb.h"
#include "core/progress.h"
#include "scatter/city.h"
#include "scatter/options.h"
#include "scatter/source_asset.h"

namespace jalousie::scatter {

/// Side of the cube or square, world units. Not for a city, whose blocks decide.
float sideOf(const Layout& layout, const SourceAsset& source);

/// Where an object stands: it is turned and scaled about the centre of its box, which is moved to a place.
struct Placement {
  glm::vec3 place;
  glm::quat turn;
  float factor;
};

/// Places layout.count objects. The box's centre of object 0 is at the origin; those of the others are uniform in the
/// cube [-side/2, side/2]^3, or in its middle plane y = 0. Deterministic in layout, side and city.
/// @param city  null, or the city whose built lots stay free
std::vector<Placement> placeObjects(const Layout& layout, float side, Progress& progress, const City* city = nullptr);

/// Moves objects up or down so that the lowest vertices of all are as low as those of the first one, which stays.
/// @param placements  not empty   @param source  with the outermost vertices (findOutermost)
/// @return  y of the ground, world units
float standOnGround(std::vector<Placement>& placements, const SourceAsset& source);

/// The instances of a part: for each object all poses of the part.
asset::Instances instancesOf(const std::vector<Placement>& placements, const SourceAsset& source,
                             const SourcePart& part);

/// Box of some instances, world space; conservative, as it bounds the rotated boxes.
Aabb boundsOf(const asset::Instances& instances, const Aabb& boxObject);

}  // namespace jalousie::scatter
