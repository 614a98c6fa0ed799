// All lengths in double precision; portals are checked relative to their first corner.
#include "core/room_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/convex_solid.h"

namespace jalousie {
namespace {

constexpr double kPlanTolerance = 1e-4;           // of the size of a room
constexpr std::uint64_t kMostWork = 1ULL << 26U;  // corners times edges

bool isUsable(double number) {
  return std::isfinite(number) && std::abs(number) <= RoomPlan::kLargest;
}

bool isUsable(const glm::dvec2& point) {
  return isUsable(point.x) && isUsable(point.y);
}

/// Calls visit(from, to) for each edge of the outline.
template <class Visit>
void visitEdges(const Room& room, const Visit& visit) {
  for (const std::vector<glm::dvec2>& loop : room.outline)
    for (std::size_t i = 0; i < loop.size(); ++i)
      visit(loop[i], loop[(i + 1) % loop.size()]);
}

std::size_t edgesOf(const Room& room) {
  std::size_t edges = 0;
  for (const std::vector<glm::dvec2>& loop : room.outline)
    edges += loop.size();
  return edges;
}

std::optional<std::string> faultOf(const Room& room) {
  if (!isUsable(room.floor) || !isUsable(room.ceiling)) return "has a height that is no usable number";
  if (!(room.floor < room.ceiling)) return "has no height";
  if (room.outline.empty()) return "has no outline";
  if (room.outline.size() > RoomPlan::kMostLoops) return fmt::format("has more than {} loops", RoomPlan::kMostLoops);
  if (edgesOf(room) > RoomPlan::kMostOutlinePoints)
    return fmt::format("has more than {} points", RoomPlan::kMostOutlinePoints);
  for (const std::vector<glm::dvec2>& loop : room.outline) {
    if (loop.size() < 3) return "has a loop of fewer than three points";
    if (!std::all_of(loop.begin(), loop.end(), [](const glm::dvec2& p) { return isUsable(p); }))
      return "has a point that is no usable number";
  }
  return std::nullopt;
}

/// Whether a point is in the room or at most `tolerance` away from its border.
bool isIn(const Room& room, const glm::dvec3& point, double tolerance) {
  if (point.y < room.floor - tolerance || point.y > room.ceiling + tolerance) return false;
  const glm::dvec2 place(point.x, point.z);
  if (isInside(room, place)) return true;
  bool near = false;
  visitEdges(room, [&](const glm::dvec2& from, const glm::dvec2& to) {
    near = near || squaredDistance(place, from, to) <= tolerance * tolerance;
  });
  return near;
}

double sizeOf(const Room& room) {
  const auto [low, high] = extentOf(room);
  return std::max({high.x - low.x, high.y - low.y, room.ceiling - room.floor});
}

/// A convex polygon, by the check of occluders.
std::optional<std::string> polygonFault(const Portal& portal) {
  if (portal.corners.size() < 3 || portal.corners.size() > RoomPlan::kMostCorners)
    return fmt::format("has not 3 to {} corners", RoomPlan::kMostCorners);
  ConvexSolid polygon;
  polygon.faces.emplace_back();
  for (const glm::dvec3& corner : portal.corners) {
    if (!isUsable(corner.x) || !isUsable(corner.y) || !isUsable(corner.z))
      return "has a corner that is no usable number";
    polygon.faces[0].push_back(static_cast<std::uint32_t>(polygon.vertices.size()));
    polygon.vertices.emplace_back(corner - portal.corners[0]);
  }
  return faultOf(polygon);
}

std::optional<std::string> faultOf(const Portal& portal, const RoomPlan& plan, std::uint64_t& work) {
  if (const std::optional<std::string> fault = polygonFault(portal)) return fault;
  if (portal.rooms[0] >= plan.rooms.size() || portal.rooms[1] >= plan.rooms.size())
    return fmt::format("names a room that is not there: {} and {} of {}", portal.rooms[0], portal.rooms[1],
                       plan.rooms.size());
  if (portal.rooms[0] == portal.rooms[1]) return "joins a room with itself";
  for (const std::uint32_t index : portal.rooms) {
    const Room& room = plan.rooms[index];
    work += portal.corners.size() * edgesOf(room);
    if (work > kMostWork) return "makes the plan too large: too many portals of rooms with long outlines";
    const double tolerance = kPlanTolerance * sizeOf(room);
    for (const glm::dvec3& corner : portal.corners)
      if (!isIn(room, corner, tolerance)) return fmt::format("reaches out of room {}", index);
  }
  return std::nullopt;
}

}  // namespace

std::array<glm::dvec2, 2> extentOf(const Room& room) {
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const std::vector<glm::dvec2>& loop : room.outline) {
    for (const glm::dvec2& point : loop) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  return {low, high};
}

bool isInside(const Room& room, const glm::dvec2& point) {
  bool inside = false;
  visitEdges(room, [&](const glm::dvec2& from, const glm::dvec2& to) {
    if ((from.y > point.y) == (to.y > point.y)) return;
    const double x = from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x);
    if (point.x < x) inside = !inside;
  });
  return inside;
}

double squaredDistance(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 along = to - from;
  const double length = glm::dot(along, along);
  const double share = length > 0.0 ? std::clamp(glm::dot(point - from, along) / length, 0.0, 1.0) : 0.0;
  const glm::dvec2 away = point - from - share * along;
  return glm::dot(away, away);
}

glm::dvec3 normalOf(const Portal& portal) {
  glm::dvec3 normal(0.0);
  const glm::dvec3& origin = portal.corners[0];
  for (std::size_t i = 1; i + 1 < portal.corners.size(); ++i)
    normal += glm::cross(portal.corners[i] - origin, portal.corners[i + 1] - origin);
  return normal;
}

std::optional<std::string> faultOf(const RoomPlan& plan) {
  if (plan.rooms.size() > RoomPlan::kMostRooms) return fmt::format("has more than {} rooms", RoomPlan::kMostRooms);
  if (plan.portals.size() > RoomPlan::kMostPortals)
    return fmt::format("has more than {} portals", RoomPlan::kMostPortals);
  for (std::size_t i = 0; i < plan.rooms.size(); ++i)
    if (const std::optional<std::string> fault = faultOf(plan.rooms[i])) return fmt::format("room {} {}", i, *fault);
  std::uint64_t work = 0;
  for (std::size_t i = 0; i < plan.portals.size(); ++i)
    if (const std::optional<std::string> fault = faultOf(plan.portals[i], plan, work))
      return fmt::format("portal {} {}", i, *fault);
  return std::nullopt;
}

void moveRooms(RoomPlan& plan, const glm::dvec3& offset) {
  for (Room& room : plan.rooms) {
    room.floor += offset.y;
    room.ceiling += offset.y;
    for (std::vector<glm::dvec2>& loop : room.outline)
      for (glm::dvec2& point : loop)
        point += glm::dvec2(offset.x, offset.z);
  }
  for (Portal& portal : plan.portals)
    for (glm::dvec3& corner : portal.corners)
      corner += offset;
}

}  // namespace jalousie
