// Measures what every culling mode culls and loses: wrong pixels against the frame without culling, culled objects and
// triangles, along four kinds of camera path (around, through, fast turns, cuts).
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/number_option.h"
#include "asset/scene_file.h"
#include "core/error.h"
#include "frustum_steps.h"
#include "gl_bench.h"
#include "scene/scene_data.h"
#include "support/culling.h"

namespace {

using namespace jalousie;

struct Mode {
  std::string name;
  CullMode cullMode;
  float cullThreshold;

  /// Must not cull a visible pixel; checked.
  bool isConservative() const { return rowOf(cullMode).conservative && cullThreshold == 1.0F; }
};
/// All rows that cull, and those with a map at a lower threshold, too.
std::vector<Mode> modes() {
  std::vector<Mode> result;
  for (const CullModeRow& row : cullModeTable()) {
    if (row.culls) result.push_back({row.name, row.id, 1.0F});
    if (row.usesMap) result.push_back({fmt::format("{}, threshold 0.95", row.name), row.id, 0.95F});
  }
  return result;
}

struct Arguments {
  std::string size = "640x360";
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t frames = 40;
  std::vector<std::string> scenes;
};

asset::SceneFile load(const std::string& scene) {
  if (scene == "ground-plane") return test::groundPlane(800, 1);
  if (scene == "leaf-cards") return test::leafCards(120, 600, 2);
  return asset::readSceneFile(scene);
}

test::CullingLoss measure(const Arguments& arguments, const test::Journey& journey, const Mode& mode) {
  render::FrameOptions options = test::pixelErrorOptions();
  options.cullMode = mode.cullMode;
  options.cullThreshold = mode.cullThreshold;
  const test::CullingLoss loss =
      test::countLoss(journey, arguments.width, arguments.height, options, 0, arguments.frames);
  if (mode.isConservative())
    bench::require(loss.wrongPixels == 0, fmt::format("{}: {} is conservative but culled {} visible pixels",
                                                      journey.name, mode.name, loss.wrongPixels));
  bench::require(loss.triangles <= loss.referenceTriangles,
                 fmt::format("{}: {} drew more triangles than there are", journey.name, mode.name));
  return loss;
}

void printHead(const Arguments& arguments, const test::Journey& journey) {
  fmt::print(
      "{}, {}x{}, {} frames; triangles in % of those without culling\n"
      "| mode | wrong pixels | worst frame | objects culled by occlusion | triangles |\n|---|---|---|---|---|\n",
      journey.name, arguments.width, arguments.height, arguments.frames);
}

void printRow(const Arguments& arguments, const Mode& mode, const test::CullingLoss& loss) {
  const auto frames = static_cast<double>(loss.frames);
  const double pixels = static_cast<double>(arguments.width) * arguments.height * frames;
  fmt::print("| {} | {} ({:.3f} %) | {} | {:.0f} per frame | {:.1f} % |\n", mode.name, loss.wrongPixels,
             100.0 * static_cast<double>(loss.wrongPixels) / pixels, loss.worstFrame,
             static_cast<double>(loss.culled) / frames,
             100.0 * static_cast<double>(loss.triangles) / static_cast<double>(loss.referenceTriangles));
  std::fflush(stdout);
}

void measureScene(const Arguments& arguments, const std::string& name, nlohmann::ordered_json& figures) {
  test::Journey journey{name, scene::buildScene(load(name)), {}, {}};
  if (journey.scene.objects.empty()) throw Error(ErrorCode::kUsage, "the scene has no objects", name);
  journey.camera = test::tour(journey.scene, arguments.frames / 4, 7);
  printHead(arguments, journey);
  for (const Mode& mode : modes()) {
    const test::CullingLoss loss = measure(arguments, journey, mode);
    printRow(arguments, mode, loss);
    figures.push_back({{"scene", name},
                       {"mode", mode.name},
                       {"frames", loss.frames},
                       {"wrong_pixels", loss.wrongPixels},
                       {"worst_frame", loss.worstFrame},
                       {"culled_occlusion", loss.culled},
                       {"triangles", loss.triangles},
                       {"triangles_without_culling", loss.referenceTriangles}});
  }
  const float aspect = static_cast<float>(arguments.width) / static_cast<float>(arguments.height);
  bench::measureFrustumSteps(journey, aspect, arguments.frames, figures);
}

/// "WxH" with both sides in [1, 8192]. Errors: kUsage.
void parseSize(Arguments& arguments) {
  char rest = 0;
  const int read = std::sscanf(arguments.size.c_str(), "%ux%u%c", &arguments.width, &arguments.height, &rest);
  if (read != 2 || arguments.width < 1 || arguments.height < 1 || arguments.width > 8192 || arguments.height > 8192)
    throw Error(ErrorCode::kUsage, fmt::format("--size {}: expected WxH with sides in 1..8192", arguments.size));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  bench::GlBench bench(
      "culling_bench", "Counts wrong pixels, culled objects and triangles of every culling mode along a camera path",
      R"(The path has four parts of equal length: around the scene, through it, fast turns, and cuts. Every frame is compared
with the same frame without culling. The exit code is 1 if a conservative mode culls a visible pixel.
Examples:
  culling_bench ground-plane leaf-cards
      measures the two procedural scenes of the tests
  culling_bench --frames 80 --size 1280x720 --json culling.json city.glb
      measures a scene of your own and writes the figures
)");
  bench.options()
      .add_option("scenes", arguments.scenes, "glTF files, or the procedural scenes ground-plane and leaf-cards")
      ->required()
      ->type_name("SCENE");
  bench.options()
      .add_option("--size", arguments.size, "Image size, at most 8192 a side; pixels")
      ->type_name("WxH")
      ->capture_default_str();
  app::addNumber(bench.options(), "--frames", arguments.frames, {4, 100000}, "Length of the path; frames");
  return bench.run(argc, argv, [&](nlohmann::ordered_json& figures) {
    parseSize(arguments);
    figures = nlohmann::ordered_json::array();
    for (const std::string& scene : arguments.scenes)
      measureScene(arguments, scene, figures);
  });
}
