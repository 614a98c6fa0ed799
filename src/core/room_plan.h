// Rooms and the portals between them: the cells and portals of Airey et al. 1990 and Luebke and Georges 1995.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace jalousie {

/// A vertical prism over any outline.
struct Room {
  std::string name;
  double floor = 0.0;    ///< least y
  double ceiling = 0.0;  ///< largest y
  /// Closed loops of (x, z), in any sense. A point is inside where a ray from it crosses an odd number of edges.
  std::vector<std::vector<glm::dvec2>> outline;

  friend bool operator==(const Room&, const Room&) = default;
};

/// A convex polygon in the border of two rooms, through which each can be seen from the other.
struct Portal {
  std::array<std::uint32_t, 2> rooms{};  ///< indices into RoomPlan::rooms
  std::vector<glm::dvec3> corners;       ///< counter-clockwise as seen from the first room

  friend bool operator==(const Portal&, const Portal&) = default;
};

/// The rooms of a scene, y up. The promise that a file makes: who stands in rooms sees nothing through their borders
/// but through portals, because opaque triangles close all the rest at every level that is drawn.
struct RoomPlan {
  static constexpr std::size_t kMostRooms = 65536;
  static constexpr std::size_t kMostPortals = 65536;
  static constexpr std::size_t kMostLoops = 4096;           ///< of a room
  static constexpr std::size_t kMostOutlinePoints = 65536;  ///< of a room
  static constexpr std::size_t kMostCorners = 32;           ///< of a portal
  static constexpr double kLargest = 1e9;                   ///< magnitude of a coordinate

  std::vector<Room> rooms;
  std::vector<Portal> portals;

  bool empty() const { return rooms.empty(); }
  friend bool operator==(const RoomPlan&, const RoomPlan&) = default;
};

/// Least and largest x and z of a room. @pre the room has a point
std::array<glm::dvec2, 2> extentOf(const Room& room);

/// Whether a point (x, z) is inside of the outline. On the outline itself either answer is possible.
bool isInside(const Room& room, const glm::dvec2& point);

/// Squared distance of a point from a segment.
double squaredDistance(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to);

/// Normal of a polygon towards the side from which it is counter-clockwise, twice its area long.
glm::dvec3 normalOf(const Portal& portal);

/// Moves all rooms and portals.
void moveRooms(RoomPlan& plan, const glm::dvec3& offset);

/// What keeps untrusted input from being a plan: numbers that are not finite or too large, rooms without height or with
/// loops of fewer than three points, too many of anything, portals that are not flat and convex, that name rooms
/// wrongly, or that lie off the border of one of their rooms. Lengths are off by at most a ten-thousandth of the
/// room's size. nullopt: nothing. O(corners times the outlines of their rooms), and refused where that is too long.
std::optional<std::string> faultOf(const RoomPlan& plan);

}  // namespace jalousie
