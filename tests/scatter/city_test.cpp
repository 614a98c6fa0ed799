// The city: lots, buildings, objects between them, camera paths, and what the file holds.
#include "scatter/city.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asset/scene_file.h"
#include "core/random.h"
#include "scatter/city_path.h"
#include "scatter/command_line.h"
#include "scatter/layout.h"
#include "scatter/report.h"
#include "scatter/scatter.h"
#include "scatter/scatter_fixtures.h"

namespace jalousie::scatter {
namespace {

constexpr float kUnit = 2.0F;
constexpr std::uint32_t kRimLots = 12;

Layout cityLayout(std::uint32_t count, float built = 1.0F) {
  Layout layout;
  layout.count = count;
  layout.shape = Shape::kCity;
  layout.built = built;
  return layout;
}

/// Footprint of a lot, x and z.
struct Square {
  glm::vec2 min;
  glm::vec2 max;
  bool meets(const Square& other) const {
    return min.x < other.max.x && other.min.x < max.x && min.y < other.max.y && other.min.y < max.y;
  }
};

Square around(const glm::vec2& middle, float reach) {
  return {middle - reach, middle + reach};
}

std::vector<Square> builtLots(const City& city) {
  std::vector<Square> lots;
  for (const Building& building : city.buildings)
    lots.push_back(around(building.place, 0.5F * kLotSide * city.unit));
  return lots;
}

bool meetsAny(const std::vector<Square>& lots, const Square& square) {
  return std::any_of(lots.begin(), lots.end(), [&](const Square& lot) { return lot.meets(square); });
}

Options parseCity(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"jalousie-scatter", "in.glb", "-o", "out.glb", "--layout", "city"});
  return *parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

ScatteredScene scatterCity(const Options& options) {
  Progress progress("test", 0, true);
  return scatterObjects(test::bakedBall(), options, progress);
}

TEST(City, EveryBlockHasAGateAndTheRestIsBuilt) {
  const City city = planCity(cityLayout(540), kUnit);
  EXPECT_EQ(city.blocks, 3U);
  EXPECT_EQ(city.buildings.size(), 9U * (kRimLots - 1));
  EXPECT_EQ(static_cast<std::size_t>(std::count(city.isBuilt.begin(), city.isBuilt.end(), 1)), city.buildings.size());
}

TEST(City, ASparseOneHasTheShareThatWasAskedFor) {
  const City city = planCity(cityLayout(24000, 0.3F), kUnit);
  EXPECT_NEAR(static_cast<double>(city.buildings.size()), 0.3 * 400.0 * (kRimLots - 1), 100.0);
  EXPECT_TRUE(planCity(cityLayout(100, 0.0F), kUnit).buildings.empty());
}

TEST(City, BuildingsStayOnTheirLotsAndLotsAreApart) {
  const City city = planCity(cityLayout(540), kUnit);
  for (const BuildingDesign& design : city.designs) {
    EXPECT_GE(design.boxes.size(), 1U);
    EXPECT_LE(design.boxes.size(), 3U);
    for (const Aabb& box : design.boxes) {
      EXPECT_EQ(box.min.y, 0.0F);
      EXPECT_LE(box.max.y, kHighestRoof * kUnit);
      for (const int axis : {0, 2}) {
        EXPECT_GT(box.min[axis], -0.5F * kLotSide * kUnit);
        EXPECT_LT(box.max[axis], 0.5F * kLotSide * kUnit);
        EXPECT_GT(box.extent()[axis], kUnit);
      }
    }
  }
  const std::vector<Square> lots = builtLots(city);
  for (std::size_t a = 0; a < lots.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(lots[a].meets(around(city.buildings[b].place, 0.49F * kLotSide * kUnit)));
}

TEST(City, IsFreeAgreesWithAllLots) {
  const City city = planCity(cityLayout(540, 0.7F), kUnit);
  const std::vector<Square> lots = builtLots(city);
  Random random(3);
  int taken = 0;
  for (int i = 0; i < 20000; ++i) {
    const float half = 0.6F * city.side();  // some outside of the city
    const glm::vec2 place(random.uniform(-half, half), random.uniform(-half, half));
    const float reach = kUnit * random.uniform(0.01F, 10.0F);
    // A gap of rounding is left to either answer.
    const bool surely = meetsAny(lots, around(place, 0.999F * reach));
    const bool maybe = meetsAny(lots, around(place, 1.001F * reach));
    if (surely != maybe) continue;
    EXPECT_EQ(city.isFree(place, reach), !surely) << place.x << " " << place.y << " " << reach;
    taken += surely ? 1 : 0;
  }
  EXPECT_GT(taken, 5000);
}

TEST(City, ObjectsStandClearOfBuildings) {
  const Layout layout = cityLayout(2000);
  const City city = planCity(layout, kUnit);
  Progress progress("test", 0, true);
  const std::vector<Placement> placements = placeObjects(layout, city.side(), progress, &city);
  const std::vector<Square> lots = builtLots(city);
  int inCourtyards = 0;
  for (const Placement& placed : placements) {
    EXPECT_FALSE(meetsAny(lots, around({placed.place.x, placed.place.z}, 0.499F * kUnit)));
    const auto fromStreet = [&](float at) {
      const float in = std::fmod((at + 0.5F * city.side()) / kUnit, kBlockPitch);
      return std::min(in, kBlockPitch - in) > 0.5F * kStreetWidth + kLotSide;
    };
    inCourtyards += fromStreet(placed.place.x) && fromStreet(placed.place.z) ? 1 : 0;
  }
  EXPECT_GT(inCourtyards, 400);
  EXPECT_LT(inCourtyards, 1600);
}

TEST(City, PathsKeepToTheStreetsOrFlyAboveAllRoofs) {
  for (const std::uint32_t count : {1U, 240U, 540U, 3000U}) {
    const City city = planCity(cityLayout(count), kUnit);
    const std::vector<CityPath> paths = cityPaths(city);
    ASSERT_EQ(paths.size(), 3U);
    for (const CityPath& path : paths) {
      const bool flies = std::string(path.name) == "flight";
      const std::vector<glm::vec3>& positions = path.path.positions;
      for (std::size_t key = 0; key + 1 < positions.size(); ++key) {
        for (const float weight : {0.0F, 0.25F, 0.5F, 0.75F}) {
          const glm::vec3 eye = glm::mix(positions[key], positions[key + 1], weight);
          if (flies)
            EXPECT_GT(eye.y, 1.2F * kHighestRoof * kUnit);
          else
            EXPECT_TRUE(city.isFree({eye.x, eye.z}, 0.5F * kUnit)) << path.name << " " << key;
        }
        EXPECT_GT(glm::dot(path.path.rotations[key], path.path.rotations[key + 1]), 0.8F) << path.name << " " << key;
      }
      EXPECT_LT(glm::distance(positions.front(), positions.back()), 1e-3F * city.side()) << "ends where it begins";
    }
  }
}

TEST(City, TheFileHasObjectsBuildingsGroundAndThreeCameras) {
  const Options options = parseCity({"--count", "120"});
  const ScatteredScene scene = scatterCity(options);
  EXPECT_EQ(scene.summary.blocks, 2U);
  EXPECT_EQ(scene.summary.buildings, 4U * (kRimLots - 1));
  EXPECT_EQ(scene.summary.trianglesFull, 120U * 128U + scene.summary.buildingTriangles + 12U);
  const test::TempFolder folder;
  asset::saveGlb(scene.model, folder / "city.glb");
  const asset::SceneFile file = asset::readSceneFile(folder / "city.glb");
  EXPECT_EQ(file.instances.size(), 120U + scene.summary.buildings + 1U);
  std::vector<std::string> names;
  for (const asset::Camera& camera : file.cameras)
    names.push_back(camera.name);
  EXPECT_EQ(names, (std::vector<std::string>{"walk", "flight", "drive"}));
  EXPECT_NE(reportJson(options, scene.summary).find("\"buildings\": 44"), std::string::npos);
  EXPECT_NE(reportLine(options, scene.summary).find("120 objects and 44 buildings in a city"), std::string::npos);
}

TEST(City, SameOptionsSameBytesOtherShareOtherBytes) {
  const std::vector<std::byte> first = asset::encodeGlb(scatterCity(parseCity({"--count", "60"})).model);
  EXPECT_EQ(asset::encodeGlb(scatterCity(parseCity({"--count", "60"})).model), first);
  EXPECT_NE(asset::encodeGlb(scatterCity(parseCity({"--count", "60", "--built", "0.5"})).model), first);
}

TEST(City, OptionsThatDoNotFitAreRefused) {
  const auto codeOf = [](std::vector<const char*> arguments) {
    return test::codeOf([&] { parseCity(std::move(arguments)); });
  };
  EXPECT_EQ(codeOf({"--count", "60", "--built", "1.5"}), ErrorCode::kUsage);
  EXPECT_EQ(codeOf({"--count", "60", "--built", "nan"}), ErrorCode::kUsage);
  EXPECT_EQ(codeOf({"--count", "60", "--scale", "1,5"}), ErrorCode::kUsage);
  EXPECT_EQ(codeOf({"--count", "60", "--occluder", "fence"}), ErrorCode::kUsage);
  EXPECT_EQ(codeOf({"--count", "60", "--layout", "ground", "--built", "0.5"}), ErrorCode::kUsage);
}

}  // namespace
}  // namespace jalousie::scatter
