// Random buildings of rooms and portals on a lattice, with an exact answer to who sees whom.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <set>
#include <vector>

#include "asset/scene_types.h"
#include "core/random.h"

namespace jalousie::test {

/// What a building is made of.
struct BuildingOptions {
  std::uint32_t blocks = 4;   ///< to a side, each three units wide
  std::uint32_t storeys = 2;  ///< each three units high
  float merged = 0.35F;       ///< share of walls between blocks that are left out, so that rooms have any shape
  float doors = 0.6F;         ///< share of walls that have a door
  float stairs = 0.2F;        ///< share of blocks with a hole in the floor
  std::uint32_t spheres = 150;
  float portalScale = 1.0F;  ///< by which portals are scaled about their middle: below 1 they promise too little
};

/// Two storeys of rooms with doors and holes in floors, on a lattice of unit cubes. All surfaces are unit squares, so
/// that no crack can open between them; each looks into one room, and walls have no thickness.
class Building {
 public:
  Building(std::uint64_t seed, const BuildingOptions& options = {});

  /// One mesh for each room, and spheres of four levels at any place, also in walls and outside; with its plan.
  const asset::SceneFile& file() const { return file_; }
  const RoomPlan& plan() const { return file_.rooms; }
  /// Room of a point; -1 outside and in blocks that are solid.
  int roomAt(const glm::dvec3& point) const;
  /// Whether the straight line from one point to another meets no wall. Both must be in rooms.
  bool sees(const glm::dvec3& from, const glm::dvec3& to) const;
  /// A point in any room, at least `margin` away from the lattice's planes.
  glm::dvec3 randomPlace(Random& random, double margin = 0.1) const;
  /// A point in a portal, which needs one.
  glm::dvec3 randomPlaceInPortal(Random& random) const;
  /// Size in units.
  glm::ivec3 size() const { return size_; }

 private:
  /// A unit square between the cube `cube` and the one before it along an axis.
  struct Face {
    int axis = 0;
    glm::ivec3 cube{0};
    auto key() const { return std::array{axis, cube.x, cube.y, cube.z}; }
    friend bool operator<(const Face& a, const Face& b) { return a.key() < b.key(); }
  };

  int& room(const glm::ivec3& cube);
  int roomOf(const glm::ivec3& cube) const;
  void divide(Random& random, const BuildingOptions& options);
  void cutDoors(Random& random, const BuildingOptions& options);
  void cutStairs(Random& random, const BuildingOptions& options);
  void addOpening(int axis, const glm::ivec3& low, const glm::ivec3& high, float scale);
  void outlineRooms();
  void addMeshes();

  glm::ivec3 size_{0};
  std::vector<int> rooms_;  ///< by cube
  std::set<Face> open_;
  asset::SceneFile file_;
};

}  // namespace jalousie::test
