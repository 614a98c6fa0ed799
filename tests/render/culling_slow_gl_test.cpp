// A thousand frames and more: every kind of camera path, moving objects, six scenes, five screen sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "support/culling.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kFramesEach = 9;  // of four kinds of path: 36 frames a size
constexpr std::pair<std::uint32_t, std::uint32_t> kSizes[] = {
    {1280, 720}, {1366, 768}, {1001, 701}, {333, 97}, {64, 64}};

class CullingSlowGl : public test::GlTest {
 protected:
  static test::Journey journey(const std::string& name, const asset::SceneFile& file, std::uint32_t movingStride) {
    test::Journey result{name, scene::buildScene(file), {}, {}};
    result.camera = test::tour(result.scene, kFramesEach, 7);
    if (movingStride > 0) result.move = test::swingObjects(result.scene, movingStride);
    return result;
  }

  static void expectLossless(const test::Journey& journey) {
    for (const auto& [width, height] : kSizes) {
      const test::CullingLoss loss =
          test::countLoss(journey, width, height, test::pixelErrorOptions(), 0, 4 * kFramesEach);
      EXPECT_EQ(loss.wrongPixels, 0U) << journey.name << " " << width << "x" << height;
      EXPECT_EQ(loss.differentDepths, 0U) << journey.name << " " << width << "x" << height;
      EXPECT_GT(loss.culled, 0U) << journey.name << " " << width << "x" << height;
      std::printf("%s %ux%u: %llu frames, %llu wrong pixels, %llu different depths, %llu objects culled\n",
                  journey.name.c_str(), width, height, static_cast<unsigned long long>(loss.frames),
                  static_cast<unsigned long long>(loss.wrongPixels),
                  static_cast<unsigned long long>(loss.differentDepths), static_cast<unsigned long long>(loss.culled));
      std::fflush(stdout);
    }
  }

  /// A scene of the thesis with the 3.7k-triangle bunny, baked and scattered by our own tools; empty without the bunny.
  static std::filesystem::path bunnies(const std::string& preset) {
    const std::filesystem::path bunny = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "assets/fetched/bunny.ply";
    if (!std::filesystem::exists(bunny)) return {};
    const std::filesystem::path folder = std::filesystem::path(JALOUSIE_BINARY_DIR) / "slow";
    std::filesystem::create_directories(folder);
    const std::string chain = (folder / "bunny.glb").string();
    const std::string scene = (folder / (preset + ".glb")).string();
    const std::string bin = JALOUSIE_BINARY_DIR "/bin/";
    EXPECT_EQ(test::runProgram(bin + "jalousie-bake", {bunny.string(), "-o", chain, "-q"}).exitCode, 0);
    EXPECT_EQ(test::runProgram(bin + "jalousie-scatter", {chain, "--preset", preset, "-o", scene, "-q"}).exitCode, 0);
    return scene;
  }

  void thesisScene(const std::string& preset) {
    const std::filesystem::path scene = bunnies(preset);
    if (scene.empty()) GTEST_SKIP() << "assets/fetched has no bunny; assets/fetch bunny gets it";
    expectLossless(journey(preset, asset::readSceneFile(scene), 11));
  }

  void realScene(const std::string& name) {
    const char* folder = std::getenv("JALOUSIE_SCENES");
    if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the two game scenes";
    expectLossless(journey(name, asset::readSceneFile(std::filesystem::path(folder) / name / "scene.gltf"), 7));
  }
};

/// Boxes, spheres, cards and slivers of sizes over four decades, thrown together, some of them far from the origin.
asset::SceneFile jumble(std::uint64_t seed) {
  Random random(seed);
  asset::SceneFile file = test::leafCards(0, 0, seed);
  file.meshes.push_back({"box", {test::box(glm::vec3(1.0F))}});
  file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  const float far = std::pow(10.0F, random.uniform(0.0F, 5.0F));
  const glm::vec3 origin(random.uniform(-far, far), random.uniform(-far, far), random.uniform(-far, far));
  const std::uint32_t count = 20 + random.below(400);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto size = [&] { return std::pow(10.0F, random.uniform(-2.5F, random.below(20) == 0 ? 1.5F : 0.3F)); };
    glm::vec3 scale = random.below(3) == 0 ? glm::vec3(size(), size(), size()) : glm::vec3(size());
    if (random.below(5) == 0) scale.z = -scale.z;
    const glm::vec3 place(random.uniform(-8, 8), random.uniform(-4, 4), random.uniform(-8, 8));
    test::addInstance(file, random.below(3), origin + place, scale, random.uniform(0, 6),
                      {random.uniform(-1, 1), 1, random.uniform(-1, 1)});
  }
  return file;
}

TEST_F(CullingSlowGl, TwoHundredJumbles) {
  std::uint64_t culled = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string name = "jumble " + std::to_string(seed);
    const test::Journey j = journey(name, jumble(seed), seed % 3 == 0 ? 4 : 0);
    Random random(seed);
    const std::uint32_t width = 1 + random.below(500);
    const std::uint32_t height = 1 + random.below(300);
    const test::CullingLoss loss = test::countLoss(j, width, height, test::pixelErrorOptions(), 0, 4 * kFramesEach);
    EXPECT_EQ(loss.wrongPixels, 0U) << name << " " << width << "x" << height;
    EXPECT_EQ(loss.differentDepths, 0U) << name << " " << width << "x" << height;
    culled += loss.culled;
  }
  std::printf("jumbles: %llu objects culled\n", static_cast<unsigned long long>(culled));
  EXPECT_GT(culled, 10000U);
}

TEST_F(CullingSlowGl, GroundPlane) {
  expectLossless(journey("ground plane", test::groundPlane(800, 1), 0));
}
TEST_F(CullingSlowGl, LeafCards) {
  expectLossless(journey("leaf cards", test::leafCards(120, 600, 2), 5));
}
TEST_F(CullingSlowGl, CornfieldCrossing) {
  realScene("cornfield_crossing");
}
TEST_F(CullingSlowGl, CandelaCity) {
  realScene("candela_city");
}
TEST_F(CullingSlowGl, Thesis5001) {
  thesisScene("thesis-5001");
}
TEST_F(CullingSlowGl, Thesis10001) {
  thesisScene("thesis-10001");
}

/// Towns with occluders, every fourth far from the origin, every second with moving houses and objects; cameras around
/// them, between and in houses, turning, and at cuts.
TEST_F(CullingSlowGl, ShadowsOfTwoHundredTownsLoseNoPixel) {
  for (const CullModeRow& row : cullModeTable()) {
    if (!row.castsShadows) continue;
    test::CullingLoss sum;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      asset::SceneFile file = test::town(10 + static_cast<std::uint32_t>(seed % 31), 150, seed);
      if (seed % 4 == 3)
        for (asset::Instance& instance : file.instances)
          instance.worldFromObject[3] += glm::vec4(20000.0F, 0.0F, -7000.0F, 0.0F);
      test::Journey town{"town", scene::buildScene(file), {}, {}};
      town.camera = test::tour(town.scene, 1, seed);
      if (seed % 2 == 1) town.move = test::swingObjects(town.scene, 3);
      FrameOptions options = test::pixelErrorOptions();
      options.cullMode = row.id;
      options.occluders.rankEvery = seed % 5 == 0 ? 3 : 1;
      const test::CullingLoss loss = test::countLoss(town, 240, 135, options, 0, 4);
      EXPECT_EQ(loss.wrongPixels, 0U) << row.name << ", town " << seed;
      EXPECT_EQ(loss.differentDepths, 0U) << row.name << ", town " << seed;
      sum.frames += loss.frames;
      sum.culled += loss.culled;
    }
    std::printf("%s: %llu frames, %llu objects culled\n", row.name, static_cast<unsigned long long>(sum.frames),
                static_cast<unsigned long long>(sum.culled));
    EXPECT_GT(sum.culled, 2000U) << row.name;
  }
}

}  // namespace
}  // namespace jalousie::render
