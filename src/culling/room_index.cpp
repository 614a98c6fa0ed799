// Outlines are tested edge by edge against the rectangle of a box; the tree only leaves out rooms that are far away.
#include "culling/room_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check.h"

namespace jalousie::culling {
namespace {

constexpr double kSlackShare = 1e-4;        // of a room's size: what faultOf() allows portals to be off
constexpr double kPortalTolerance = 1e-6;   // of a portal's size
constexpr std::size_t kPairsPerObject = 8;  // more objects than have so many rooms on average are everywhere

/// A rectangle of (x, z).
struct Rectangle {
  glm::dvec2 min;
  glm::dvec2 max;
};

Rectangle rectangleOf(const Aabb& box, double slack) {
  return {glm::dvec2(box.min.x, box.min.z) - slack, glm::dvec2(box.max.x, box.max.z) + slack};
}

/// The part of a segment in a rectangle, as shares of its length.
std::optional<std::array<double, 2>> clipped(const glm::dvec2& from, const glm::dvec2& to, const Rectangle& rectangle) {
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = to[axis] - from[axis];
    if (along == 0.0) {
      if (from[axis] < rectangle.min[axis] || from[axis] > rectangle.max[axis]) return std::nullopt;
      continue;
    }
    const double a = (rectangle.min[axis] - from[axis]) / along;
    const double b = (rectangle.max[axis] - from[axis]) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return std::nullopt;
  return std::array{first, last};
}

float floatBelow(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

float floatAbove(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// Whether a point lies in a flat convex polygon.
bool isInPolygon(const Portal& portal, const glm::dvec3& point) {
  const glm::dvec3 normal = glm::normalize(normalOf(portal));
  const glm::dvec3& origin = portal.corners[0];
  double size = 0.0;
  for (const glm::dvec3& corner : portal.corners)
    size = std::max(size, glm::length(corner - origin));
  const double tolerance = kPortalTolerance * size;
  if (!(std::abs(glm::dot(normal, point - origin)) <= tolerance)) return false;
  for (std::size_t i = 0; i < portal.corners.size(); ++i) {
    const glm::dvec3& from = portal.corners[i];
    const glm::dvec3 along = portal.corners[(i + 1) % portal.corners.size()] - from;
    if (!(glm::dot(glm::cross(normal, along), point - from) >= -tolerance * glm::length(along))) return false;
  }
  return true;
}

}  // namespace

RoomIndex::RoomIndex(const RoomPlan& plan) : plan_(plan), firstPortal_(plan.rooms.size() + 1) {
  std::vector<Aabb> boxes;
  for (const Room& room : plan.rooms) {
    const auto [low, high] = extentOf(room);
    const double slack = kSlackShare * std::max({high.x - low.x, high.y - low.y, room.ceiling - room.floor});
    slack_.push_back(slack);
    boxes.push_back({{floatBelow(low.x - slack), floatBelow(room.floor - slack), floatBelow(low.y - slack)},
                     {floatAbove(high.x + slack), floatAbove(room.ceiling + slack), floatAbove(high.y + slack)}});
  }
  tree_ = buildHierarchy(boxes);
  for (const Portal& portal : plan.portals)
    for (const std::uint32_t room : portal.rooms)
      ++firstPortal_[room + 1];
  for (std::size_t room = 0; room < plan.rooms.size(); ++room)
    firstPortal_[room + 1] += firstPortal_[room];
  portals_.resize(2 * plan.portals.size());
  std::vector<std::uint32_t> next(firstPortal_.begin(), firstPortal_.end() - 1);
  for (std::uint32_t i = 0; i < plan.portals.size(); ++i)
    for (const std::uint32_t room : plan.portals[i].rooms)
      portals_[next[room]++] = i;
}

bool RoomIndex::meets(std::uint32_t room, const Aabb& boxWorld) const {
  const Room& prism = plan_.rooms[room];
  const double slack = slack_[room];
  if (double{boxWorld.max.y} < prism.floor - slack || double{boxWorld.min.y} > prism.ceiling + slack) return false;
  const Rectangle rectangle = rectangleOf(boxWorld, slack);
  for (const std::vector<glm::dvec2>& loop : prism.outline)
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (clipped(loop[i], loop[(i + 1) % loop.size()], rectangle)) return true;
  return isInside(prism, 0.5 * (rectangle.min + rectangle.max));
}

bool RoomIndex::holds(std::uint32_t room, const glm::dvec3& pointWorld) const {
  const Room& prism = plan_.rooms[room];
  return pointWorld.y >= prism.floor && pointWorld.y <= prism.ceiling &&
         isInside(prism, glm::dvec2(pointWorld.x, pointWorld.z));
}

bool RoomIndex::isInPortal(std::uint32_t room, std::span<const glm::dvec3> points) const {
  const std::span<const std::uint32_t> portals = portalsOf(room);
  return std::any_of(portals.begin(), portals.end(), [&](std::uint32_t portal) {
    return std::all_of(points.begin(), points.end(),
                       [&](const glm::dvec3& point) { return isInPolygon(plan_.portals[portal], point); });
  });
}

/// Whether the floor or ceiling at a height crosses the box, and is not a portal there.
bool RoomIndex::isClosedAbove(std::uint32_t room, const Aabb& boxWorld, double height) const {
  if (height < double{boxWorld.min.y} || height > double{boxWorld.max.y}) return false;
  const auto [low, high] = rectangleOf(boxWorld, 0.0);
  const std::array points = {glm::dvec3(low.x, height, low.y), glm::dvec3(high.x, height, low.y),
                             glm::dvec3(high.x, height, high.y), glm::dvec3(low.x, height, high.y)};
  return !isInPortal(room, points);
}

bool RoomIndex::isOpenIn(std::uint32_t room, const Aabb& boxWorld) const {
  const Room& prism = plan_.rooms[room];
  const double low = std::max(double{boxWorld.min.y}, prism.floor);
  const double high = std::min(double{boxWorld.max.y}, prism.ceiling);
  if (low > high) return true;
  const Rectangle rectangle = rectangleOf(boxWorld, 0.0);
  for (const std::vector<glm::dvec2>& loop : prism.outline) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2& from = loop[i];
      const glm::dvec2& to = loop[(i + 1) % loop.size()];
      const std::optional<std::array<double, 2>> part = clipped(from, to, rectangle);
      if (!part) continue;
      const glm::dvec2 a = glm::mix(from, to, (*part)[0]);
      const glm::dvec2 b = glm::mix(from, to, (*part)[1]);
      const std::array corners = {glm::dvec3(a.x, low, a.y), glm::dvec3(b.x, low, b.y), glm::dvec3(b.x, high, b.y),
                                  glm::dvec3(a.x, high, a.y)};
      if (!isInPortal(room, corners)) return false;
    }
  }
  return !isClosedAbove(room, boxWorld, prism.floor) && !isClosedAbove(room, boxWorld, prism.ceiling);
}

RoomObjects::RoomObjects(std::size_t rooms, std::size_t objects) : first_(rooms + 1) {
  pairs_.reserve(kPairsPerObject * objects);
  objects_.reserve(kPairsPerObject * objects);
  everywhere_.reserve(objects);
}

void RoomObjects::assign(const RoomIndex& index, std::span<const Aabb> boundsWorld) {
  pairs_.clear();
  everywhere_.clear();
  for (std::uint32_t object = 0; object < boundsWorld.size(); ++object) {
    const std::size_t before = pairs_.size();
    bool fits = true;
    index.visitRooms(boundsWorld[object], [&](std::uint32_t room) {
      fits = fits && pairs_.size() < pairs_.capacity() && pairs_.size() - before < kMostRoomsOfObject;
      if (fits) pairs_.push_back({room, object});
    });
    if (fits && pairs_.size() > before) continue;
    pairs_.resize(before, Pair{});
    everywhere_.push_back(object);
  }
  // A counting sort by room. While objects are put in, an entry is the next free place of the room before it.
  std::fill(first_.begin(), first_.end(), 0U);
  for (const Pair& pair : pairs_)
    if (pair.room + 2 < first_.size()) ++first_[pair.room + 2];
  for (std::size_t room = 2; room < first_.size(); ++room)
    first_[room] += first_[room - 1];
  objects_.resize(pairs_.size());
  for (const Pair& pair : pairs_)
    objects_[first_[pair.room + 1]++] = pair.object;
  JAL_CHECK(first_.back() == pairs_.size());
}

}  // namespace jalousie::culling
