// Levels as rooms, portals and closed surfaces; broken files are refused.
#include "wad/convert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "asset/gltf_file.h"
#include "asset/scene_file.h"
#include "asset/scene_rooms.h"
#include "core/error.h"
#include "core/random.h"
#include "wad/level_mesh.h"
#include "wad/wad_fixtures.h"
#include "wad/walk_path.h"

namespace jalousie::wad {
namespace {

ConvertedLevel convert(const test::LevelMaker& level, bool opensDoors = true) {
  return convertLevel(WadFile(test::wadOf(level)), "MAP01", opensDoors);
}

TEST(ConvertLevel, SectorsBecomeRoomsAndOpeningsPortals) {
  const ConvertedLevel level = convert(test::houseLevel());
  EXPECT_EQ(level.summary.rooms, 4U);
  EXPECT_EQ(level.summary.openedDoors, 1U);
  EXPECT_EQ(level.summary.portals, 6U) << "four around the pool, two of the door";
  EXPECT_EQ(level.summary.things, 2U);
  const RoomPlan plan = asset::roomsOf(level.model);
  EXPECT_EQ(faultOf(plan), std::nullopt);
  const auto isIn = [&](std::size_t room, double x, double y) {
    return isInside(plan.rooms[room], {x / kUnits, -y / kUnits});
  };
  EXPECT_TRUE(isIn(0, 32, 32));
  EXPECT_FALSE(isIn(0, 80, 80)) << "the pillar";
  EXPECT_FALSE(isIn(0, 300, 100)) << "the pool";
  EXPECT_TRUE(isIn(1, 300, 100));
  EXPECT_EQ(plan.rooms[2].ceiling, (96.0 - 4.0) / kUnits) << "the door opens to the lower ceiling, less 4";
  EXPECT_GT(level.summary.seconds, 1.0);
}

TEST(ConvertLevel, ClosedDoorsHaveNoPortals) {
  const ConvertedLevel level = convert(test::houseLevel(), false);
  EXPECT_EQ(level.summary.rooms, 3U);
  EXPECT_EQ(level.summary.portals, 4U);
  EXPECT_EQ(level.summary.openedDoors, 0U);
}

TEST(ConvertLevel, TheFileIsReadBackWithItsRooms) {
  const ConvertedLevel level = convert(test::houseLevel());
  const asset::SceneFile scene = asset::readScene(level.model, "level.glb");
  EXPECT_EQ(scene.rooms, asset::roomsOf(level.model));
  EXPECT_EQ(scene.instances.size(), 4U + 2U);
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].name, "walk");
}

/// Positions of triangles of all rooms.
std::vector<std::array<glm::vec3, 3>> trianglesOf(const test::LevelMaker& maker, bool opensDoors, LevelPlan& plan) {
  Level level = readLevel(WadFile(test::wadOf(maker)), "MAP01");
  if (opensDoors) openDoors(level);
  const SectorParts parts = divideSectors(level);
  plan = planLevel(level, parts);
  std::vector<std::array<glm::vec3, 3>> triangles;
  for (const RoomMesh& mesh : makeMeshes(level, parts, plan))
    for (const auto& [look, surface] : mesh)
      for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        triangles.push_back({surface.positions[surface.indices[i]], surface.positions[surface.indices[i + 1]],
                             surface.positions[surface.indices[i + 2]]});
  return triangles;
}

using Key = std::array<float, 6>;
Key keyOf(const glm::vec3& a, const glm::vec3& b) {
  return {a.x, a.y, a.z, b.x, b.y, b.z};
}

/// All rooms together are closed: every directed edge has its opposite. No crack can open where vertices are shared.
void expectClosed(const test::LevelMaker& maker, bool opensDoors) {
  LevelPlan plan;
  std::map<Key, int> edges;
  for (const std::array<glm::vec3, 3>& triangle : trianglesOf(maker, opensDoors, plan))
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[keyOf(triangle[i], triangle[(i + 1) % 3])];
  for (const auto& [edge, count] : edges) {
    const Key opposite = {edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]};
    const auto other = edges.find(opposite);
    EXPECT_EQ(other == edges.end() ? 0 : other->second, count);
  }
}

TEST(LevelMesh, SurfacesHaveNoCracks) {
  expectClosed(test::houseLevel(), true);
  expectClosed(test::houseLevel(), false);
}

/// The volume inside of the surfaces is that of the rooms, because walls look into rooms.
TEST(LevelMesh, SurfacesEncloseTheRooms) {
  for (const bool opensDoors : {true, false}) {
    LevelPlan plan;
    double volume = 0.0;
    for (const auto& [a, b, c] : trianglesOf(test::houseLevel(), opensDoors, plan))
      volume -= glm::dot(glm::dvec3(a), glm::cross(glm::dvec3(b), glm::dvec3(c))) / 6.0;
    double expected = 0.0;
    for (const Room& room : plan.plan.rooms) {
      double area = 0.0;
      for (const std::vector<glm::dvec2>& loop : room.outline)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const glm::dvec2& to = loop[(i + 1) % loop.size()];
          area -= 0.5 * (loop[i].x * to.y - loop[i].y * to.x);
        }
      expected += area * (room.ceiling - room.floor);
    }
    EXPECT_NEAR(volume, expected, 1e-6 * expected);
  }
}

/// Stars around stars: many holes and corners that lean both ways.
test::LevelMaker randomLevel(std::uint64_t seed) {
  Random random(seed);
  test::LevelMaker level;
  const auto star = [&](int middleX, int middleY, double radius, int right, int left) {
    std::vector<int> corners;
    const int count = 3 + static_cast<int>(random.below(12));
    for (int i = 0; i < count; ++i) {  // clockwise
      const double angle = -6.283185 * i / count;
      const double reach = radius * double{random.uniform(0.55F, 1.0F)};
      corners.push_back(level.vertex(middleX + static_cast<int>(reach * std::cos(angle)),
                                     middleY + static_cast<int>(reach * std::sin(angle))));
    }
    level.outline(corners, right, left);
  };
  const int outer = level.sector(0, 100 + static_cast<int>(random.below(100)));
  star(0, 0, 8000.0, outer, -1);
  for (int i = 0; i < 12; ++i) {
    const int x = -1400 + 900 * (i % 4);
    const int y = -900 + 900 * (i / 4);
    const int inner = level.sector(static_cast<int>(random.below(120)) - 60, 80 + static_cast<int>(random.below(90)));
    star(x, y, 400.0, inner, outer);
    if (random.below(2) == 0) star(x, y, 90.0, level.sector(-8, 40), inner);
  }
  return level;
}

TEST(LevelMesh, RandomLevelsHaveNoCracksEither) {
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    expectClosed(randomLevel(seed), true);
}

TEST(WalkPath, StaysInRoomsAwayFromWalls) {
  Level level = readLevel(WadFile(test::wadOf(test::houseLevel())), "MAP01");
  openDoors(level);
  const LevelPlan plan = planLevel(level, divideSectors(level));
  const WalkPath path = walkThrough(level, plan);
  ASSERT_GT(path.positions.size(), 5U);
  for (const glm::vec3& eye : path.positions) {
    const bool isIn = std::any_of(plan.plan.rooms.begin(), plan.plan.rooms.end(), [&](const Room& room) {
      return isInside(room, {eye.x, eye.z}) && double{eye.y} > room.floor && double{eye.y} < room.ceiling;
    });
    EXPECT_TRUE(isIn);
  }
  EXPECT_GT(path.positions.back().x, 528.0F / 32.0F) << "the room behind the door is the farthest place";
  EXPECT_TRUE(std::is_sorted(path.times.begin(), path.times.end()));
  level.things.clear();
  EXPECT_TRUE(walkThrough(level, plan).times.empty());
}

std::string failureOf(const std::vector<std::byte>& bytes, ErrorCode expected, const std::string& map = "MAP01") {
  try {
    convertLevel(WadFile(bytes), map, true);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), expected) << error.what();
    return error.what();
  }
  return "";
}

TEST(ConvertLevel, BrokenFilesAreRefusedByName) {
  const auto fails = [](const test::LevelMaker& level, ErrorCode code, const char* part) {
    const std::string failure = failureOf(test::wadOf(level), code);
    EXPECT_NE(failure.find(part), std::string::npos) << failure;
  };
  test::LevelMaker level = test::houseLevel();
  level.line(0, 9999, 0);
  fails(level, ErrorCode::kMalformed, "line 22 refers to number 9999");
  level = test::houseLevel();
  level.lines.resize(level.lines.size() - 14);
  fails(level, ErrorCode::kUnsupported, "is not closed at");
  level = test::houseLevel();
  level.lines.pop_back();
  fails(level, ErrorCode::kMalformed, "no multiple of 14");
  level = test::houseLevel();
  level.sides[28] = std::byte{99};
  fails(level, ErrorCode::kMalformed, "side 0 refers to number 99 of 4");
  level = test::LevelMaker();
  fails(level, ErrorCode::kUnsupported, "no sector that is closed");
  level.sector(0, 64);
  level.outline({level.vertex(0, 0), level.vertex(64, 64), level.vertex(64, 0), level.vertex(0, 63)}, 0);
  fails(level, ErrorCode::kUnsupported, "MAP01");
  EXPECT_NE(failureOf(test::wadOf(test::houseLevel()), ErrorCode::kUsage, "E1M1").find("may be: MAP01"),
            std::string::npos);
  EXPECT_NE(failureOf({}, ErrorCode::kUnsupported).find("no WAD file"), std::string::npos);
  std::vector<std::byte> wad = test::wadOf(test::houseLevel());
  wad.resize(wad.size() - 1);
  EXPECT_NE(failureOf(wad, ErrorCode::kMalformed).find("directory lies outside"), std::string::npos);
}

/// Any byte may be anything: a file is converted to a plan without faults, or refused with a code.
TEST(ConvertLevel, FlippedBytesAreRefusedOrHarmless) {
  const std::vector<std::byte> wad = test::wadOf(test::houseLevel());
  Random random(1);
  std::uint64_t converted = 0;
  std::uint64_t refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> broken = wad;
    for (std::uint32_t k = 0; k <= random.below(3); ++k)
      broken[random.below(static_cast<std::uint32_t>(broken.size()))] = static_cast<std::byte>(random.below(256));
    if (random.below(10) == 0) broken.resize(random.below(static_cast<std::uint32_t>(broken.size())));
    try {
      const ConvertedLevel level = convertLevel(WadFile(broken), "MAP01", random.below(2) == 0);
      EXPECT_EQ(faultOf(asset::roomsOf(level.model)), std::nullopt);
      ++converted;
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::kInternal);
      ++refused;
    }
  }
  EXPECT_GT(converted, 300U);
  EXPECT_GT(refused, 300U);
}

}  // namespace
}  // namespace jalousie::wad
