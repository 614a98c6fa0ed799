// Rooms seen through portals over random buildings: nothing that a line of sight reaches is missing.
#include "culling/portal_culling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "scene/camera.h"
#include "support/building.h"

namespace jalousie::culling {
namespace {

using test::Building;

constexpr glm::uvec2 kPixels(640, 360);

/// A view from a place. @param fovY  radians
PortalView viewFrom(const glm::dvec3& eye, const glm::vec3& target, float fovY = 0.9F, float zNear = 0.02F) {
  scene::Camera camera = scene::lookAt(glm::vec3(eye), target, {glm::vec3(-50), glm::vec3(50)});
  camera.fovY = fovY;
  camera.zNear = zNear;
  return makePortalView(scene::clipFromWorld(camera, 640.0F / 360.0F), glm::vec4(glm::vec3(eye), zNear),
                        glm::vec4(camera.forwardWorld(), 0.0F), scene::focalPixels(camera, kPixels), kPixels);
}

glm::vec3 randomTarget(Random& random, const glm::dvec3& eye) {
  return glm::vec3(eye) + glm::vec3(random.uniform(-1, 1), random.uniform(-0.6F, 0.6F), random.uniform(-1, 1));
}

/// A place in a room, one time in three in a portal.
glm::dvec3 randomEye(const Building& building, Random& random) {
  const bool inFrame = random.below(3) == 0 && !building.plan().portals.empty();
  return inFrame ? building.randomPlaceInPortal(random) : building.randomPlace(random);
}

/// Rooms alone.
struct Sight {
  bool decides = false;
  std::vector<ScreenWindow> windows;
  QueryFigures figures;
};

Sight look(const RoomPlan& plan, const PortalView& view, PortalReach reach = PortalReach::kAll) {
  PortalCulling culling(plan, 1);
  const std::vector<Aabb> bounds = {{glm::vec3(-1e6F), glm::vec3(-1e6F)}};
  culling.follow(bounds);
  Sight sight;
  const std::vector<std::uint32_t> places = {0};
  sight.decides = !culling.cull(view, bounds, places, reach, sight.figures).empty();
  sight.windows.assign(culling.windows().begin(), culling.windows().end());
  return sight;
}

std::optional<glm::dvec2> onScreen(const PortalView& view, const glm::dvec3& point) {
  const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(point, 1.0);
  if (clip.w < view.zNear) return std::nullopt;
  const glm::dvec2 place = glm::dvec2(clip) / clip.w;
  if (glm::any(glm::greaterThan(glm::abs(place), glm::dvec2(1.0)))) return std::nullopt;
  return place;
}

/// Points that are seen and lie outside of the rectangle of their room.
std::uint64_t lostPoints(const Building& building, PortalReach reach, Random& random, std::uint64_t& found) {
  constexpr int kViews = 6;
  constexpr int kPoints = 300;
  std::uint64_t lost = 0;
  for (int v = 0; v < kViews; ++v) {
    const glm::dvec3 eye = randomEye(building, random);
    const PortalView view = viewFrom(eye, randomTarget(random, eye));
    const Sight sight = look(building.plan(), view, reach);
    if (!sight.decides) continue;
    for (int i = 0; i < kPoints; ++i) {
      const glm::dvec3 point = building.randomPlace(random);
      const std::optional<glm::dvec2> place = onScreen(view, point);
      if (!place || !building.sees(eye, point)) continue;
      ++found;
      const ScreenWindow& window = sight.windows[static_cast<std::size_t>(building.roomAt(point))];
      if (!window.holds({*place, *place})) ++lost;
    }
  }
  return lost;
}

TEST(PortalCulling, HoldsEveryPointThatIsSeen) {
  Random random(1);
  std::uint64_t found = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    EXPECT_EQ(lostPoints(Building(seed, {.spheres = 0}), PortalReach::kAll, random, found), 0U) << seed;
  EXPECT_GT(found, 5000U);
}

TEST(PortalCulling, DirectNeighboursLoseWhatIsSeenThroughTwoPortals) {
  Random random(2);
  std::uint64_t found = 0;
  std::uint64_t lost = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    lost += lostPoints(Building(seed, {.spheres = 0}), PortalReach::kNeighbours, random, found);
  EXPECT_GT(lost, 10U);
  EXPECT_LT(2 * lost, found) << "the next rooms are seen";
}

TEST(PortalCulling, PortalsThatAreALittleTooSmallAreNoticed) {
  Random random(3);
  std::uint64_t found = 0;
  std::uint64_t lost = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    lost += lostPoints(Building(seed, {.spheres = 0, .portalScale = 0.9F}), PortalReach::kAll, random, found);
  EXPECT_GT(lost, 10U);
}

/// Every portal again and again, until no rectangle grows.
std::vector<ScreenWindow> plainWindows(const RoomPlan& plan, const PortalView& view, const RoomIndex& index) {
  std::vector<ScreenWindow> windows(plan.rooms.size());
  for (std::uint32_t room = 0; room < plan.rooms.size(); ++room)
    if (index.meets(room, view.nearBox())) windows[room] = view.screen();
  for (bool grows = true; grows;) {
    grows = false;
    for (const Portal& portal : plan.portals) {
      for (const std::uint32_t from : {0U, 1U}) {
        const std::optional<ScreenWindow> through = windowOf(view, portal);
        if (!through || !canCross(view, portal, from)) continue;
        ScreenWindow& behind = windows[portal.rooms[1 - from]];
        const ScreenWindow seen = intersection(windows[portal.rooms[from]], *through);
        if (seen.empty() || behind.holds(seen)) continue;
        behind = hull(behind, seen);
        grows = true;
      }
    }
  }
  return windows;
}

TEST(PortalCulling, FindsTheSameRectanglesAsAllPortalsInTurn) {
  Random random(4);
  std::uint64_t seen = 0;
  std::uint64_t rooms = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Building building(seed, {.blocks = 3 + random.below(4), .spheres = 0});
    const RoomIndex index(building.plan());
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 eye = randomEye(building, random);
      const PortalView view = viewFrom(eye, randomTarget(random, eye));
      const Sight sight = look(building.plan(), view);
      if (!sight.decides) continue;
      EXPECT_EQ(sight.windows, plainWindows(building.plan(), view, index));
      EXPECT_LE(sight.figures.portals, 8 * building.plan().portals.size());
      seen += sight.figures.rooms;
      rooms += building.plan().rooms.size();
    }
  }
  EXPECT_LT(2 * seen, rooms) << "fewer than half of the rooms are seen";
}

TEST(PortalCulling, ANarrowerViewSeesNoOtherRoom) {
  Random random(5);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Building building(seed, {.spheres = 0});
    const glm::dvec3 eye = building.randomPlace(random, 0.2);
    const glm::vec3 target = randomTarget(random, eye);
    const Sight wide = look(building.plan(), viewFrom(eye, target, 1.2F));
    const Sight narrow = look(building.plan(), viewFrom(eye, target, 0.5F));
    ASSERT_TRUE(wide.decides && narrow.decides);
    for (std::size_t room = 0; room < wide.windows.size(); ++room)
      EXPECT_LE(wide.windows[room].empty(), narrow.windows[room].empty());
  }
}

TEST(PortalCulling, DecidesNothingOutsideAndAtWalls) {
  Random random(6);
  std::uint64_t decided = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Building building(seed, {.spheres = 0});
    EXPECT_FALSE(look(building.plan(), viewFrom({-2, 1, 4}, {4, 1, 4})).decides);
    EXPECT_FALSE(look(building.plan(), viewFrom({4, 30, 4}, {4, 1, 5})).decides);
    const glm::dvec3 eye = building.randomPlace(random);
    const glm::dvec3 atFloor(eye.x, 3.0 * std::floor(eye.y / 3.0) + 0.005, eye.z);
    EXPECT_EQ(look(building.plan(), viewFrom(atFloor, randomTarget(random, eye))).decides,
              building.roomAt(atFloor - glm::dvec3(0, 0.02, 0)) >= 0 &&
                  building.sees(atFloor, atFloor - glm::dvec3(0, 0.02, 0)));
    decided += look(building.plan(), viewFrom(eye, randomTarget(random, eye))).decides ? 1U : 0U;
  }
  EXPECT_EQ(decided, 30U);
}

/// Who stands with the near plane in the frame of a door has rooms on both sides.
TEST(PortalCulling, BothSidesOfAFrameAreEntered) {
  Random random(7);
  std::uint64_t decided = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Building building(seed, {.spheres = 0});
    const RoomPlan& plan = building.plan();
    if (plan.portals.empty()) continue;
    const Portal& portal = plan.portals[seed % plan.portals.size()];
    const glm::dvec3 middle = 0.5 * (portal.corners[0] + portal.corners[2]);
    const PortalView view = viewFrom(middle, randomTarget(random, middle));
    const Sight sight = look(plan, view);
    if (!sight.decides) continue;
    ++decided;
    for (const std::uint32_t room : portal.rooms)
      EXPECT_EQ(sight.windows[room], view.screen());
  }
  EXPECT_GT(decided, 40U);
}

TEST(PortalCulling, AParallelViewDecidesNothing) {
  const Building building(1);
  Random random(8);
  PortalView view = viewFrom(building.randomPlace(random), {4, 1, 4});
  view.query.orthographic = true;
  EXPECT_FALSE(look(building.plan(), view).decides);
}

/// Objects of the building: its rooms' meshes, and spheres.
std::vector<Aabb> objectBoxes(const Building& building, Random& random, std::size_t count) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 middle(building.randomPlace(random));
    const glm::vec3 half(random.uniform(0.01F, 0.5F), random.uniform(0.01F, 0.5F), random.uniform(0.01F, 0.5F));
    boxes.push_back({middle - half, middle + half});
  }
  boxes.push_back({{-9, 0, 0}, {-8, 1, 1}});  // outside
  boxes.push_back({{-9, -9, -9}, {99, 99, 99}});
  return boxes;
}

/// Objects with a point that is seen are not hidden, and an order of places does not matter.
TEST(PortalCulling, NoObjectWithASeenPointIsHidden) {
  Random random(9);
  std::uint64_t hidden = 0;
  std::uint64_t seen = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Building building(seed, {.spheres = 0});
    const std::vector<Aabb> boxes = objectBoxes(building, random, 200);
    std::vector<std::uint32_t> places(boxes.size());
    std::iota(places.rbegin(), places.rend(), 0U);
    PortalCulling culling(building.plan(), boxes.size());
    culling.follow(boxes);
    const glm::dvec3 eye = building.randomPlace(random, 0.2);
    const PortalView view = viewFrom(eye, randomTarget(random, eye));
    QueryFigures figures;
    const auto bits = culling.cull(view, boxes, places, PortalReach::kAll, figures);
    ASSERT_FALSE(bits.empty());
    for (std::size_t object = 0; object < boxes.size(); ++object) {
      const bool isHidden = (bits[places[object] / 32] >> places[object] % 32 & 1U) == 0;
      hidden += isHidden ? 1U : 0U;
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 share(random.uniform(), random.uniform(), random.uniform());
        const glm::dvec3 point = glm::mix(glm::dvec3(boxes[object].min), glm::dvec3(boxes[object].max), share);
        if (building.roomAt(point) < 0 || !onScreen(view, point) || !building.sees(eye, point)) continue;
        ++seen;
        EXPECT_FALSE(isHidden) << "object " << object << " of building " << seed;
      }
    }
    EXPECT_EQ(figures.nodesVisited > 0, figures.rooms > 0);
  }
  EXPECT_GT(hidden, 4000U);
  EXPECT_GT(seen, 3000U);
}

/// Who meets whom by the cubes of the lattice.
TEST(RoomIndex, FindsTheRoomsThatABoxMeets) {
  Random random(10);
  std::uint64_t met = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Building building(seed, {.blocks = 5, .spheres = 0});
    const RoomIndex index(building.plan());
    for (const Aabb& box : objectBoxes(building, random, 50)) {
      std::vector<bool> expected(building.plan().rooms.size());
      const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(box.min)), 0);
      const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(box.max)), building.size() - 1);
      for (glm::ivec3 cube = first; cube.y <= last.y; ++cube.y)
        for (cube.z = first.z; cube.z <= last.z; ++cube.z)
          for (cube.x = first.x; cube.x <= last.x; ++cube.x)
            if (const int room = building.roomAt(glm::dvec3(cube) + 0.5); room >= 0)
              expected[static_cast<std::size_t>(room)] = true;
      std::vector<bool> found(expected.size());
      index.visitRooms(box, [&](std::uint32_t room) {
        EXPECT_FALSE(found[room]) << "twice";
        found[room] = true;
      });
      for (std::uint32_t room = 0; room < found.size(); ++room) {
        EXPECT_EQ(found[room], index.meets(room, box)) << "the tree and the plain test";
        if (expected[room]) {
          EXPECT_TRUE(found[room]);
        } else if (found[room]) {  // within the slack of a border
          EXPECT_FALSE(index.meets(room, {box.min + 0.01F, box.max - 0.01F}));
        }
        met += found[room] ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(met, 3000U);
}

/// In a box that is open, no line of sight from its middle to its border is blocked.
TEST(RoomIndex, ABoxThatIsOpenHasNoWallInIt) {
  Random random(11);
  std::uint64_t open = 0;
  std::uint64_t closed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Building building(seed, {.spheres = 0});
    const RoomIndex index(building.plan());
    for (int i = 0; i < 60; ++i) {
      const glm::dvec3 eye = randomEye(building, random);
      const float half = random.uniform(0.01F, 0.3F);
      const Aabb box{glm::vec3(eye) - half, glm::vec3(eye) + half};
      bool isOpen = true;
      index.visitRooms(box, [&](std::uint32_t room) { isOpen = isOpen && index.isOpenIn(room, box); });
      bool isFree = true;
      for (int k = 0; k < 60; ++k) {
        const glm::dvec3 share(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const glm::dvec3 point = eye + 0.999 * double{half} * share;
        isFree = isFree && building.roomAt(point) >= 0 && building.sees(eye, point);
      }
      EXPECT_TRUE(isFree || !isOpen) << "building " << seed;
      (isOpen ? open : closed) += 1;
    }
  }
  EXPECT_GT(open, 500U);
  EXPECT_GT(closed, 200U);
}

TEST(RoomObjects, ObjectsInNoRoomAndInTooManyAreEverywhere) {
  RoomPlan plan;
  for (int i = 0; i < 200; ++i) {
    Room room;
    room.ceiling = 1.0;
    room.outline = {{{i, 0}, {i + 1, 0}, {i + 1, 1}, {i, 1}}};
    plan.rooms.push_back(room);
  }
  const RoomIndex index(plan);
  RoomObjects objects(plan.rooms.size(), 4);
  const std::vector<Aabb> boxes = {{{-5, 0, 0}, {-4, 1, 1}},
                                   {{0, 0, 0}, {199, 1, 1}},
                                   {{3.5F, 0.2F, 0.2F}, {3.6F, 0.4F, 0.4F}},
                                   {{198.4F, 0.2F, 0.2F}, {199.6F, 0.4F, 0.4F}}};
  objects.assign(index, boxes);
  EXPECT_EQ(std::vector(objects.everywhere().begin(), objects.everywhere().end()), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(objects.in(3).size(), 1U);
  EXPECT_EQ(objects.in(3)[0], 2U);
  EXPECT_EQ(objects.in(198)[0], 3U);
  EXPECT_EQ(objects.in(199)[0], 3U);
  EXPECT_TRUE(objects.in(50).empty());
}

/// Two objects that are each in more rooms than memory is kept for leave no room to others.
TEST(RoomObjects, MoreRoomsThanThereIsMemoryForLoseNothing) {
  RoomPlan plan;
  for (int i = 0; i < 40; ++i) {
    Room room;
    room.ceiling = 1.0;
    room.outline = {{{i, 0}, {i + 1, 0}, {i + 1, 1}, {i, 1}}};
    plan.rooms.push_back(room);
  }
  RoomObjects objects(plan.rooms.size(), 3);
  objects.assign(RoomIndex(plan), std::vector<Aabb>(3, Aabb{{0.5F, 0, 0}, {39.5F, 1, 1}}));
  for (std::uint32_t object = 0; object < 3; ++object) {
    bool isThere = std::count(objects.everywhere().begin(), objects.everywhere().end(), object) == 1;
    isThere = isThere || std::count(objects.in(7).begin(), objects.in(7).end(), object) == 1;
    EXPECT_TRUE(isThere) << object;
  }
}

}  // namespace
}  // namespace jalousie::culling
