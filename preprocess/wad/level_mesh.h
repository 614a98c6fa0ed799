// The surfaces of a level, one mesh for each room: floor, ceiling and walls, without cracks between them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "wad/level_plan.h"

namespace jalousie::wad {

/// What a surface shows.
struct SurfaceLook {
  std::string texture;
  bool isWall = false;
  std::int32_t light = 0;  ///< of its sector, in steps

  friend auto operator<=>(const SurfaceLook&, const SurfaceLook&) = default;
};

/// Triangles with flat normals, scene units.
struct Surface {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> indices;
};

/// The surfaces of one room, by their look.
using RoomMesh = std::map<SurfaceLook, Surface>;

/// By room. Walls have a vertex wherever a floor or ceiling meets one of their upright edges, so that neighbours share
/// all vertices. Skies are closed by their ceiling. Errors: of triangulate.
std::vector<RoomMesh> makeMeshes(const Level& level, const SectorParts& parts, const LevelPlan& plan);

}  // namespace jalousie::wad
