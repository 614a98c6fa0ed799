// A thousand frames and more: every kind of camera path, moving objects, six scenes, five screen sizes.
#include <gtest/gtest.h>

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
      const test::CullingLoss loss = test::countLoss(journey, width, height, {}, 0, 4 * kFramesEach);
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

}  // namespace
}  // namespace jalousie::render
