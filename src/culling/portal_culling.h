// What is seen from a room through portals: rooms by rectangles of the screen, and then objects.
//
// Luebke and Georges 1995, "Portals and mirrors": a portal's rectangle, cut with the one that its room is seen through.
// Equations and the promise of a file: docs/cells_and_portals.md
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "culling/occluder_options.h"
#include "culling/query_figures.h"
#include "culling/room_index.h"

namespace jalousie::culling {

/// A rectangle of the screen in normalised device coordinates. Default: empty.
struct ScreenWindow {
  glm::dvec2 min{std::numeric_limits<double>::infinity()};
  glm::dvec2 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y; }
  bool holds(const ScreenWindow& other) const {
    return other.empty() ||
           (glm::all(glm::lessThanEqual(min, other.min)) && glm::all(glm::greaterThanEqual(max, other.max)));
  }
  void add(const glm::dvec2& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  friend bool operator==(const ScreenWindow&, const ScreenWindow&) = default;
};
ScreenWindow intersection(const ScreenWindow& a, const ScreenWindow& b);
/// The smallest rectangle that holds both.
ScreenWindow hull(const ScreenWindow& a, const ScreenWindow& b);

/// What portals need to know of a camera.
struct PortalView {
  QueryView query;
  glm::dmat4 clipFromWorld{1.0};
  double zNear = 0.0;     ///< distance of the near plane
  glm::dvec2 pixel{0.0};  ///< width and height of a pixel, normalised device coordinates

  /// All that is drawn: the screen with a pixel around it.
  ScreenWindow screen() const { return {-1.0 - pixel, 1.0 + pixel}; }
  Aabb nearBox() const;  ///< around the eye: holds the rectangle of the near plane
};
/// @param viewport  pixels; the others as makeQueryView
PortalView makePortalView(const glm::mat4& clipFromWorld, const glm::vec4& eyeWorld, const glm::vec4& forwardWorld,
                          float focalPixels, const glm::uvec2& viewport);

/// What a portal covers of the screen, a pixel wider on each side: vertices snap to a grid. The whole screen where it
/// may reach the near plane; nullopt where it lies behind the eye.
std::optional<ScreenWindow> windowOf(const PortalView& view, const Portal& portal);
/// What a box covers; the box is grown as boxes of queries are.
ScreenWindow windowOf(const PortalView& view, const Aabb& boxWorld);

/// Whether rays from the eye can cross a portal from one of its rooms. @param from  0 or 1, of Portal::rooms
bool canCross(const PortalView& view, const Portal& portal, std::uint32_t from);

/// Finds what is seen.
class PortalCulling {
 public:
  /// @param plan  without faults; outlives the object
  PortalCulling(const RoomPlan& plan, std::size_t objects);

  /// Follows objects that moved. Allocates nothing. @param boundsWorld  by object
  void follow(std::span<const Aabb> boundsWorld);

  /// Verdicts of one frame. Allocates nothing. Empty where everything is drawn: the eye is in no room, so near to a
  /// wall that the near plane may lie behind it, or the camera is orthographic.
  /// @param boundsWorld  by object, those of follow()   @param placeOf  place of each object in the result
  /// @param figures  rooms, portals and objects that were tested are added
  /// @return  [(objects + 31) / 32] a bit for each place: 1 where the object is not hidden
  std::span<const std::uint32_t> cull(const PortalView& view, std::span<const Aabb> boundsWorld,
                                      std::span<const std::uint32_t> placeOf, PortalReach reach, QueryFigures& figures);

  /// Of the last cull(), by room: the rectangle that all sight of the room lies in; empty where it is not seen. The
  /// least one for which W(behind) holds W(room) cut with the portal, over all portals that can be crossed: it does not
  /// depend on the order of the portals.
  std::span<const ScreenWindow> windows() const { return windows_; }
  const RoomIndex& rooms() const { return index_; }
  const RoomObjects& objects() const { return objects_; }

 private:
  /// Fills windows_ from the rooms of the eye. @return  whether that says what is hidden
  bool spread(const PortalView& view, PortalReach reach, QueryFigures& figures);
  bool enterFirst(const PortalView& view);
  void enter(std::uint32_t room, const ScreenWindow& window);
  void look(const PortalView& view, std::uint32_t room, QueryFigures& figures);
  void show(std::uint32_t object, std::span<const std::uint32_t> placeOf);

  RoomIndex index_;
  RoomObjects objects_;
  std::vector<ScreenWindow> windows_;   ///< by room
  std::vector<std::uint32_t> queue_;    ///< ring of rooms whose window has grown
  std::vector<std::uint8_t> isQueued_;  ///< by room
  std::size_t queueFirst_ = 0;
  std::size_t queueCount_ = 0;
  std::vector<std::uint32_t> notHidden_;  ///< bits by place
};

}  // namespace jalousie::culling
