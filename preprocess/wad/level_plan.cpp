// Portals are upright rectangles, counter-clockwise as seen from the right side of their line.
#include "wad/level_plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace jalousie::wad {
namespace {

Portal portalOf(const Level& level, const Line& line, const Opening& opening) {
  const glm::dvec2 from(level.vertices[line.ends[0]]);
  const glm::dvec2 to(level.vertices[line.ends[1]]);
  Portal portal;
  portal.corners = {sceneFromLevel(from, opening.low), sceneFromLevel(to, opening.low),
                    sceneFromLevel(to, opening.high), sceneFromLevel(from, opening.high)};
  return portal;
}

Room roomOfPart(const Level& level, const SectorPart& part) {
  const Sector& sector = level.sectors[part.sector];
  Room room;
  room.name = fmt::format("sector {}", part.sector);
  room.floor = sector.floor / kUnits;
  room.ceiling = sector.ceiling / kUnits;
  for (const std::vector<std::uint32_t>& loop : part.loops) {
    std::vector<glm::dvec2>& outline = room.outline.emplace_back();
    for (const std::uint32_t vertex : loop) {
      const glm::dvec3 place = sceneFromLevel(glm::dvec2(level.vertices[vertex]), 0.0);
      outline.emplace_back(place.x, place.z);
    }
  }
  return room;
}

}  // namespace

glm::dvec3 sceneFromLevel(const glm::dvec2& place, double height) {
  return glm::dvec3(place.x, height, -place.y) / kUnits;
}

Opening openingOf(const Level& level, const Line& line) {
  const Sector& right = level.sectors[level.sides[*line.sides[0]].sector];
  const Sector& left = level.sectors[level.sides[*line.sides[1]].sector];
  return {std::max(right.floor, left.floor), std::min(right.ceiling, left.ceiling)};
}

LevelPlan planLevel(const Level& level, const SectorParts& parts) {
  LevelPlan result;
  for (const SectorPart& part : parts.parts) {
    const Sector& sector = level.sectors[part.sector];
    std::optional<std::uint32_t>& room = result.roomOf.emplace_back();
    if (sector.floor >= sector.ceiling) continue;
    room = static_cast<std::uint32_t>(result.plan.rooms.size());
    result.plan.rooms.push_back(roomOfPart(level, part));
  }
  for (std::size_t l = 0; l < level.lines.size(); ++l) {
    const auto& [right, left] = parts.partOf[l];
    if (!right || !left) continue;
    const Opening opening = openingOf(level, level.lines[l]);
    if (opening.low >= opening.high || !result.roomOf[*right] || !result.roomOf[*left]) continue;
    Portal portal = portalOf(level, level.lines[l], opening);
    portal.rooms = {*result.roomOf[*right], *result.roomOf[*left]};
    if (portal.rooms[0] != portal.rooms[1]) result.plan.portals.push_back(std::move(portal));
  }
  return result;
}

}  // namespace jalousie::wad
