// A town for methods that know occluders before the frame: streets, closed buildings of boxes, courtyards.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/aabb.h"
#include "scatter/options.h"

namespace jalousie::scatter {

// Lengths in units of a city; a unit is the diagonal of the scattered object.
inline constexpr std::uint32_t kBlockLots = 4;  ///< along a side of a block; the lots inside its rim are a courtyard
inline constexpr float kLotSide = 8.0F;
inline constexpr float kStreetWidth = 6.0F;
inline constexpr float kBlockPitch = kBlockLots * kLotSide + kStreetWidth;  ///< from street to street
inline constexpr float kHighestRoof = 22.0F;
/// The largest objects that all streets have room for, in diagonals of the object.
inline constexpr float kLargestInStreets = 4.0F;
inline constexpr std::uint32_t kMostBlocks = 200;  ///< along a side

/// A kind of building: one to three closed boxes, which may overlap. The ground is y = 0, the lot is centred on the
/// origin. World units.
struct BuildingDesign {
  std::vector<Aabb> boxes;
};

struct Building {
  std::uint32_t design = 0;
  std::uint32_t quarterTurns = 0;  ///< about y
  glm::vec2 place{0.0F};           ///< x and z of the middle of its lot, world units
};

/// Square blocks with streets around each of them, centred on the origin.
struct City {
  float unit = 1.0F;         ///< world units
  std::uint32_t blocks = 1;  ///< along a side
  std::vector<BuildingDesign> designs;
  std::vector<Building> buildings;
  std::vector<std::uint8_t> isBuilt;  ///< by lot, [blocks * kBlockLots]^2, row by row along x

  /// Between the middles of the outermost streets, world units.
  float side() const { return static_cast<float>(blocks) * kBlockPitch * unit; }
  /// Middle of a street, x or z, world units. @param street  0 to blocks
  float streetAt(std::uint32_t street) const {
    return (static_cast<float>(street) - 0.5F * static_cast<float>(blocks)) * kBlockPitch * unit;
  }
  /// Whether a square stays clear of all built lots. @param place  x and z of its middle   @param reach  half its side;
  /// world units
  bool isFree(const glm::vec2& place, float reach) const;
};

/// Plans a town for layout.count objects, or of layout.side. Of the lots on the rim of a block one stays open; a share
/// of layout.built of the others gets a building. Deterministic in layout and unit. @param unit  world units
City planCity(const Layout& layout, float unit);

}  // namespace jalousie::scatter
