// The rooms and portals of a level: connected parts of sectors, and the openings of lines with two sides.
#pragma once

#include "core/room_plan.h"
#include "wad/sector_parts.h"

namespace jalousie::wad {

/// Units of a level to a unit of the scene: a player of 56 is 1.75 high.
inline constexpr double kUnits = 32.0;

/// Place in the scene: east is x, north is -z.
glm::dvec3 sceneFromLevel(const glm::dvec2& place, double height);

/// The free heights between the two sectors of a line.
struct Opening {
  std::int32_t low = 0;
  std::int32_t high = 0;  ///< at most `low`: closed
};
/// @pre the line has two sides
Opening openingOf(const Level& level, const Line& line);

struct LevelPlan {
  RoomPlan plan;
  std::vector<std::optional<std::uint32_t>> roomOf;  ///< by part; none where the sector has no height
};

/// A room for each part with height, a portal for each opening between two rooms.
LevelPlan planLevel(const Level& level, const SectorParts& parts);

}  // namespace jalousie::wad
