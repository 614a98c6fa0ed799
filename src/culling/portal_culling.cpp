// Rooms whose rectangle has grown wait in a queue, each at most once; rectangles only grow.
#include "culling/portal_culling.h"

#include <algorithm>

#include "core/check.h"
#include "culling/occluder_culling.h"

namespace jalousie::culling {
namespace {

constexpr std::uint32_t kBitsOfWord = 32;
/// Times that a room is left on average before everything is drawn. Plans of buildings need one to three.
constexpr std::size_t kMostVisits = 64;
/// How far the corners of a portal may lie beside its plane, of its size.
constexpr double kFlatness = 1e-3;

glm::dvec2 projected(const glm::dvec4& clip) {
  return glm::dvec2(clip) / clip.w;
}

Aabb boxOf(const Portal& portal) {
  Aabb box;
  for (const glm::dvec3& corner : portal.corners)
    box.add(glm::vec3(corner));
  return box;
}

}  // namespace

ScreenWindow intersection(const ScreenWindow& a, const ScreenWindow& b) {
  const ScreenWindow both{glm::max(a.min, b.min), glm::min(a.max, b.max)};
  return both.empty() ? ScreenWindow{} : both;
}

ScreenWindow hull(const ScreenWindow& a, const ScreenWindow& b) {
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

Aabb PortalView::nearBox() const {
  return {query.eyeWorld - query.nearReach, query.eyeWorld + query.nearReach};
}

PortalView makePortalView(const glm::mat4& clipFromWorld, const glm::vec4& eyeWorld, const glm::vec4& forwardWorld,
                          float focalPixels, const glm::uvec2& viewport) {
  return {.query = makeQueryView(clipFromWorld, eyeWorld, forwardWorld, focalPixels, viewport),
          .clipFromWorld = glm::dmat4(clipFromWorld),
          .zNear = double{eyeWorld.w},
          .pixel = 2.0 / glm::dvec2(viewport)};
}

std::optional<ScreenWindow> windowOf(const PortalView& view, const Portal& portal) {
  if (view.query.reachesNear(boxOf(portal))) return view.screen();
  // In view, the portal is farther than the near plane: cut off what is nearer than half of that.
  const double nearest = 0.5 * view.zNear;
  ScreenWindow window;
  for (std::size_t i = 0; i < portal.corners.size(); ++i) {
    const glm::dvec4 from = view.clipFromWorld * glm::dvec4(portal.corners[i], 1.0);
    const glm::dvec4 to = view.clipFromWorld * glm::dvec4(portal.corners[(i + 1) % portal.corners.size()], 1.0);
    if (from.w >= nearest) window.add(projected(from));
    if ((from.w >= nearest) == (to.w >= nearest)) continue;
    const glm::dvec4 crossing = glm::mix(from, to, (nearest - from.w) / (to.w - from.w));
    window.add(glm::dvec2(crossing) / nearest);
  }
  if (window.empty()) return std::nullopt;
  return ScreenWindow{window.min - view.pixel, window.max + view.pixel};
}

ScreenWindow windowOf(const PortalView& view, const Aabb& boxWorld) {
  if (view.query.reachesNear(boxWorld)) return view.screen();
  const float growth = shadowGrowth(view.query, boxWorld);
  const glm::dvec3 low(boxWorld.min - growth);
  const glm::dvec3 high(boxWorld.max + growth);
  ScreenWindow window;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                           (corner & 4) != 0 ? high.z : low.z);
    const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) return view.screen();
    window.add(projected(clip));
  }
  return window;
}

bool canCross(const PortalView& view, const Portal& portal, std::uint32_t from) {
  const glm::dvec3 normal = normalOf(portal);
  const glm::dvec3& origin = portal.corners[0];
  double size = 0.0;
  for (const glm::dvec3& corner : portal.corners)
    size = std::max(size, glm::length(corner - origin));
  const double distance = glm::dot(normal, glm::dvec3(view.query.eyeWorld) - origin) / glm::length(normal);
  const double slack = kFlatness * size + double{view.query.nearReach};
  return (from == 0 ? distance : -distance) >= -slack;
}

PortalCulling::PortalCulling(const RoomPlan& plan, std::size_t objects)
    : index_(plan),
      objects_(plan.rooms.size(), objects),
      windows_(plan.rooms.size()),
      queue_(plan.rooms.size()),
      isQueued_(plan.rooms.size()),
      notHidden_((objects + kBitsOfWord - 1) / kBitsOfWord) {}

void PortalCulling::follow(std::span<const Aabb> boundsWorld) {
  objects_.assign(index_, boundsWorld);
}

void PortalCulling::enter(std::uint32_t room, const ScreenWindow& window) {
  if (window.empty() || windows_[room].holds(window)) return;
  windows_[room] = hull(windows_[room], window);
  if (isQueued_[room] != 0) return;
  isQueued_[room] = 1;
  queue_[(queueFirst_ + queueCount_++) % queue_.size()] = room;
}

/// Enters the rooms around the eye. @return  whether the near plane lies in them alone
bool PortalCulling::enterFirst(const PortalView& view) {
  const Aabb box = view.nearBox();
  bool isOpen = true;
  bool isIn = false;
  index_.visitRooms(box, [&](std::uint32_t room) {
    isIn = isIn || index_.holds(room, glm::dvec3(view.query.eyeWorld));
    isOpen = isOpen && index_.isOpenIn(room, box);
    enter(room, view.screen());
  });
  return isIn && isOpen;
}

/// Enters all rooms behind the portals of a room.
void PortalCulling::look(const PortalView& view, std::uint32_t room, QueryFigures& figures) {
  const ScreenWindow window = windows_[room];
  for (const std::uint32_t index : index_.portalsOf(room)) {
    const Portal& portal = index_.plan().portals[index];
    const std::uint32_t from = portal.rooms[0] == room ? 0 : 1;
    ++figures.portals;
    if (!canCross(view, portal, from)) continue;
    if (const std::optional<ScreenWindow> through = windowOf(view, portal))
      enter(portal.rooms[1 - from], intersection(window, *through));
  }
}

bool PortalCulling::spread(const PortalView& view, PortalReach reach, QueryFigures& figures) {
  std::fill(windows_.begin(), windows_.end(), ScreenWindow{});
  std::fill(isQueued_.begin(), isQueued_.end(), std::uint8_t{0});
  queueFirst_ = queueCount_ = 0;
  if (view.query.orthographic || !enterFirst(view)) return false;
  const std::size_t most = reach == PortalReach::kNeighbours ? queueCount_ : kMostVisits * windows_.size();
  for (std::size_t visit = 0; queueCount_ > 0 && visit < most; ++visit) {
    const std::uint32_t room = queue_[queueFirst_];
    queueFirst_ = (queueFirst_ + 1) % queue_.size();
    --queueCount_;
    isQueued_[room] = 0;
    look(view, room, figures);
  }
  return queueCount_ == 0 || reach == PortalReach::kNeighbours;
}

void PortalCulling::show(std::uint32_t object, std::span<const std::uint32_t> placeOf) {
  notHidden_[placeOf[object] / kBitsOfWord] |= 1U << placeOf[object] % kBitsOfWord;
}

std::span<const std::uint32_t> PortalCulling::cull(const PortalView& view, std::span<const Aabb> boundsWorld,
                                                   std::span<const std::uint32_t> placeOf, PortalReach reach,
                                                   QueryFigures& figures) {
  JAL_CHECK(placeOf.size() == boundsWorld.size());
  if (!spread(view, reach, figures)) return {};
  std::fill(notHidden_.begin(), notHidden_.end(), 0U);
  for (const std::uint32_t object : objects_.everywhere())
    show(object, placeOf);
  for (std::uint32_t room = 0; room < windows_.size(); ++room) {
    if (windows_[room].empty()) continue;
    ++figures.rooms;
    for (const std::uint32_t object : objects_.in(room)) {
      ++figures.nodesVisited;
      const ScreenWindow window = windowOf(view, boundsWorld[object]);
      if (!intersection(windows_[room], window).empty()) show(object, placeOf);
    }
  }
  return notHidden_;
}

}  // namespace jalousie::culling
