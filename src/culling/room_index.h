// Where the rooms of a plan are: which of them a box meets, and which objects are in which room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/room_plan.h"
#include "culling/hierarchy.h"

namespace jalousie::culling {

/// Finds rooms by place.
class RoomIndex {
 public:
  /// @param plan  without faults; outlives the index
  explicit RoomIndex(const RoomPlan& plan);

  const RoomPlan& plan() const { return plan_; }
  /// Whether a box meets the prism of a room, or comes as near to it as borders of files may be off (a ten-thousandth
  /// of the room's size). Exact for the outline, however it is bent.
  bool meets(std::uint32_t room, const Aabb& boxWorld) const;
  /// Calls visit(room) for each room that meets() a box.
  template <class Visit>
  void visitRooms(const Aabb& boxWorld, const Visit& visit) const {
    const auto overlaps = [&](const Aabb& room) {
      return glm::all(glm::lessThanEqual(room.min, boxWorld.max)) &&
             glm::all(glm::greaterThanEqual(room.max, boxWorld.min));
    };
    visitObjects(tree_, overlaps, [&](std::uint32_t room) {
      if (meets(room, boxWorld)) visit(room);
    });
  }
  /// Whether a point is inside of a room.
  bool holds(std::uint32_t room, const glm::dvec3& pointWorld) const;
  /// Whether every piece of a room's border that is in a box lies in one portal of the room: nobody leaves the room
  /// through anything else there. A piece that only several portals cover together counts as closed.
  bool isOpenIn(std::uint32_t room, const Aabb& boxWorld) const;
  /// Indices of the portals in the border of a room.
  std::span<const std::uint32_t> portalsOf(std::uint32_t room) const {
    return std::span(portals_).subspan(firstPortal_[room], firstPortal_[room + 1] - firstPortal_[room]);
  }

 private:
  bool isInPortal(std::uint32_t room, std::span<const glm::dvec3> points) const;
  bool isClosedAbove(std::uint32_t room, const Aabb& boxWorld, double height) const;

  const RoomPlan& plan_;
  std::vector<double> slack_;  ///< by room
  SpatialHierarchy tree_;
  std::vector<std::uint32_t> firstPortal_;  ///< [rooms + 1]
  std::vector<std::uint32_t> portals_;      ///< room after room
};

/// The objects of each room. An object is in every room that its box meets.
class RoomObjects {
 public:
  static constexpr std::size_t kMostRoomsOfObject = 64;

  RoomObjects(std::size_t rooms, std::size_t objects);

  /// Assigns all objects anew. Allocates nothing. @param boundsWorld  by object
  void assign(const RoomIndex& index, std::span<const Aabb> boundsWorld);
  /// Objects in a room, ascending.
  std::span<const std::uint32_t> in(std::uint32_t room) const {
    return std::span(objects_).subspan(first_[room], first_[room + 1] - first_[room]);
  }
  /// Objects in no room, and in more rooms than are worth a list: no portal hides them. Ascending.
  std::span<const std::uint32_t> everywhere() const { return everywhere_; }

 private:
  struct Pair {
    std::uint32_t room;
    std::uint32_t object;
  };
  std::vector<Pair> pairs_;  ///< memory for most pairs
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> objects_;
  std::vector<std::uint32_t> everywhere_;
};

}  // namespace jalousie::culling
