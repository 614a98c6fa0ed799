// What every culling mode loses and saves on a scene: wrong pixels against the frame without culling, hidden objects
// and triangles, along four kinds of camera path (around, through, fast turns, cuts). The honest numbers of every mode.
//
//   build/release/bin/culling_bench [--json] [--size WxH] [--frames N] SCENE...
//
// SCENE is a glTF file, or ground-plane or leaf-cards: the procedural scenes of the tests.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "core/error.h"
#include "platform/headless_context.h"
#include "support/culling.h"

namespace {

using namespace jalousie;

struct Mode {
  const char* name;
  gpu::uint cullMode;
  float cullThreshold;
};
constexpr Mode kModes[] = {
    {"frustum", gpu::kCullFrustum, 1.0F},           {"hom", gpu::kCullHom, 1.0F},
    {"hom, threshold 0.95", gpu::kCullHom, 0.95F},  {"hom-depth", gpu::kCullHomDepth, 1.0F},
    {"hom-depth, 0.95", gpu::kCullHomDepth, 0.95F}, {"hiz", gpu::kCullHiz, 1.0F},
};

struct Arguments {
  bool json = false;
  std::uint32_t width = 640;
  std::uint32_t height = 360;
  std::uint32_t frames = 40;
  std::vector<std::string> scenes;
};

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const bool hasValue = i + 1 < argc;
    if (std::strcmp(argv[i], "--json") == 0) {
      arguments.json = true;
    } else if (std::strcmp(argv[i], "--size") == 0 && hasValue) {
      if (std::sscanf(argv[++i], "%ux%u", &arguments.width, &arguments.height) != 2) return false;
    } else if (std::strcmp(argv[i], "--frames") == 0 && hasValue) {
      arguments.frames = static_cast<std::uint32_t>(std::strtoul(argv[++i], nullptr, 10));
    } else if (argv[i][0] != '-') {
      arguments.scenes.emplace_back(argv[i]);
    } else {
      return false;
    }
  }
  const bool sizeFits =
      arguments.width >= 1 && arguments.height >= 1 && arguments.width <= 8192 && arguments.height <= 8192;
  return !arguments.scenes.empty() && sizeFits && arguments.frames >= 4;
}

asset::SceneFile load(const std::string& scene) {
  if (scene == "ground-plane") return test::groundPlane(800, 1);
  if (scene == "leaf-cards") return test::leafCards(120, 600, 2);
  return asset::readSceneFile(scene);
}

void report(const Arguments& arguments, const test::Journey& journey, nlohmann::ordered_json& json) {
  if (!arguments.json)
    std::printf(
        "%s, %ux%u, %u frames\n| mode | wrong pixels | worst frame | objects hidden | triangles "
        "|\n|---|---|---|---|---|\n",
        journey.name.c_str(), arguments.width, arguments.height, arguments.frames);
  for (const Mode& mode : kModes) {
    render::FrameOptions options = test::pixelErrorOptions();
    options.cullMode = mode.cullMode;
    options.cullThreshold = mode.cullThreshold;
    const test::CullingLoss loss =
        test::countLoss(journey, arguments.width, arguments.height, options, 0, arguments.frames);
    const double pixels = static_cast<double>(arguments.width) * arguments.height * static_cast<double>(loss.frames);
    const double share = 100.0 * static_cast<double>(loss.wrongPixels) / pixels;
    const double triangles = 100.0 * static_cast<double>(loss.triangles) / static_cast<double>(loss.referenceTriangles);
    if (arguments.json) {
      json.push_back({{"scene", journey.name},
                      {"mode", mode.name},
                      {"frames", loss.frames},
                      {"wrong_pixels", loss.wrongPixels},
                      {"worst_frame", loss.worstFrame},
                      {"hidden", loss.culled},
                      {"triangles", loss.triangles},
                      {"triangles_without_culling", loss.referenceTriangles}});
    } else {
      std::printf("| %s | %llu (%.3f %%) | %llu | %.0f a frame | %.1f %% |\n", mode.name,
                  static_cast<unsigned long long>(loss.wrongPixels), share,
                  static_cast<unsigned long long>(loss.worstFrame),
                  static_cast<double>(loss.culled) / static_cast<double>(loss.frames), triangles);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(stderr,
                 "usage: culling_bench [--json] [--size WxH] [--frames N] SCENE...   (a glTF file, ground-plane or "
                 "leaf-cards)\n");
    return 2;
  }
  try {
    const platform::HeadlessContext context(false);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const std::string& file : arguments.scenes) {
      test::Journey journey{file, scene::buildScene(load(file)), {}, {}};
      if (journey.scene.objects.empty()) throw Error(ErrorCode::kUsage, "the scene is empty", file);
      journey.camera = test::tour(journey.scene, arguments.frames / 4, 7);
      report(arguments, journey, json);
    }
    if (arguments.json) std::printf("%s\n", json.dump(2).c_str());
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "culling_bench: %s\n", error.what());
    return error.exitCode();
  }
}
