// Measures what levels by visibility save, and how stable they are, against the strongest baselines.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "core/error.h"
#include "gl_bench.h"
#include "lv_prove.h"
#include "lv_setup.h"

namespace jalousie::bench {
namespace {

constexpr const char* kExamples =
    R"(WHAT chooses the measurement:
  worth         triangles, image error and frame time at the same camera
  measures      triangles and image error for every visibility measure
  fit           triangles of --lod price at equal error, for several caps and kinds of the error, with the means over
                all views and the price that has the error of one pixel; 640x360
  best          triangles at equal error of --lod price and of the best choice of one level per object, which knows the
                error of every level; 640x360
  prove         triangles at equal PSNR, SSIM and FLIP of every level rule, with and without cells, over those of
                two-phase culling with levels by pixel error on whole objects; still and moving; 640x360
  prove-table   the same table and its means from files that prove --json wrote: lv_bench prove-table FILE.json...
  calm          LOD switches on a path of 0.25 degrees per frame and under jitter, and the change that one switch makes
  calm-default  the same for the temporally stable configurations only
  masking       tolerable error of one object behind holes of 1 to 64 pixels over that behind a window, by every image
                metric, for occluders of three greys, with the range over all views; 256x256
  masking-cost  triangles and times of frames with --masking over those without
With fit, best, prove and masking, a VIEW that ends in .glb or .gltf is another scene, and the next views are views of
it.
VIEW is a frame of the scene's camera path, or EYE:LOOK as X,Y,Z:X,Y,Z in world units. The baselines are two-phase
culling and frustum culling with levels by pixel error. The exit code is 1 if a picture or a count is wrong.
Examples:
  lv_bench worth city.glb 300 900
      measures two frames of the camera path
  lv_bench fit city.glb 0,2,9:0,0,0 crowd.glb 300 900
      fits the constants of --lod price over two scenes
  lv_bench best crowd.glb 300 900
      says how far the default is from the best choice of levels in two frames
  lv_bench prove city.glb 0,2,9:0,0,0 crowd.glb 300 900 --json prove.json
      makes the proving table of three views and writes the figures, with all sweeps
  lv_bench prove-table prove.json other.json
      joins the tables of two runs
  lv_bench prove city.glb 0,2,9:0,0,0 --only still --candidates price,price+cells
      repeats a part of it
  lv_bench calm city.glb 0,2,9:0,0,0 --json calm.json
      measures one view and writes the figures
  lv_bench masking bunny.glb 0,8,30:0,4.8,0
      asks every image metric how much error a sieve hides
)";

struct Arguments {
  std::string what;
  std::string scene;
  std::vector<std::string> views;
  std::string only;
  std::vector<std::string> candidates;

  bool proves() const { return what == "prove"; }
  bool takesScenes() const { return what == "fit" || what == "best" || what == "masking" || proves(); }
};

void addOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("what", arguments.what, "Measurement")
      ->required()
      ->check(CLI::IsMember({"worth", "measures", "fit", "best", "prove", "prove-table", "calm", "calm-default",
                             "masking", "masking-cost"})
                  .description(""))
      ->type_name("worth|measures|fit|best|prove|prove-table|calm|calm-default|masking|masking-cost");
  app.add_option("scene", arguments.scene, "Baked glTF or GLB file")->required()->type_name("SCENE");
  app.add_option("views", arguments.views, "Frames or points")->type_name("VIEW");
  app.add_option("--only", arguments.only, "prove: leave out the other part [both]")
      ->check(CLI::IsMember({"still", "moving"}).description(""))
      ->type_name("still|moving");
  app.add_option("--candidates", arguments.candidates,
                 fmt::format("prove: measure only these [{}]", fmt::join(proveCandidates(), ",")))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(proveCandidates()).description(""))
      ->type_name("NAME,...");
}

/// The scene whose views come next.
struct LoadedScene {
  std::string name;
  scene::SceneData whole;
  scene::SceneData divided;  ///< with cells; empty unless asked for

  LoadedScene(const std::string& path, bool divide) : name(path) {
    const asset::SceneFile file = asset::readSceneFile(path);
    whole = scene::buildScene(file);
    if (whole.objects.empty()) throw Error(ErrorCode::kUnsupported, "the scene has no triangles", path);
    if (divide) divided = scene::buildScene(file, {.cells = {scene::CellOptions::Kind::kAutomatic}});
  }
};

void measure(const Arguments& arguments, const LoadedScene& scene, const std::string& text,
             nlohmann::ordered_json& figures) {
  const LvView view{scene.whole, scene.name, text};
  if (arguments.what == "fit") {
    measureFit(view, figures);
  } else if (arguments.what == "best") {
    measureBest(view, figures);
  } else if (arguments.proves()) {
    const std::size_t first = figures["rows"].size();
    measureProve(view, scene.divided,
                 {arguments.only != "moving", arguments.only != "still",
                  arguments.candidates.empty() ? proveCandidates() : arguments.candidates},
                 figures);
    printProveRows(figures, first);
  } else if (arguments.what == "masking") {
    measureMasking(view, figures);
  } else if (arguments.what == "masking-cost") {
    measureMaskingCost(view, figures);
  } else if (arguments.what.starts_with("calm")) {
    measureCalm(view, arguments.what == "calm-default", figures);
  } else {
    measureWorth(view, arguments.what == "measures", figures);
  }
}

/// The rows and sweeps of a file that prove wrote. Errors: kFileNotFound, kMalformed.
nlohmann::ordered_json readFigures(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::kFileNotFound, "cannot be opened", path);
  const auto json = nlohmann::ordered_json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("figures") || !json["figures"].contains("rows") ||
      !json["figures"].contains("sweeps"))
    throw Error(ErrorCode::kMalformed, "not written by lv_bench prove --json", path);
  return json["figures"];
}

/// The table of several runs.
void joinTables(const Arguments& arguments, nlohmann::ordered_json& figures) {
  std::vector<std::string> files = arguments.views;
  files.insert(files.begin(), arguments.scene);
  figures = nlohmann::ordered_json::object();
  for (const char* key : {"rows", "sweeps"})
    figures[key] = nlohmann::ordered_json::array();
  for (const std::string& file : files) {
    const nlohmann::ordered_json read = readFigures(file);
    for (const char* key : {"rows", "sweeps"})
      for (const nlohmann::ordered_json& entry : read[key])
        figures[key].push_back(entry);
  }
  printProveHead();
  printProveRows(figures, 0);
  printProveMeans(figures);
}

void measureAll(const Arguments& arguments, nlohmann::ordered_json& figures) {
  if (!arguments.proves() && !(arguments.only.empty() && arguments.candidates.empty()))
    throw Error(ErrorCode::kUsage, "--only and --candidates are options of prove (see --help)");
  if (arguments.what == "prove-table") return joinTables(arguments, figures);
  if (arguments.views.empty()) throw Error(ErrorCode::kUsage, "a VIEW is needed (see --help)");
  if (arguments.proves()) {
    figures = {{"rows", nlohmann::ordered_json::array()}, {"sweeps", nlohmann::ordered_json::array()}};
    printProveHead();
  } else {
    figures = nlohmann::ordered_json::array();
  }
  if (arguments.what == "best") printBestHead();
  auto scene = std::make_unique<LoadedScene>(arguments.scene, arguments.proves());
  for (const std::string& view : arguments.views) {
    if (arguments.takesScenes() && (view.ends_with(".glb") || view.ends_with(".gltf")))
      scene = std::make_unique<LoadedScene>(view, arguments.proves());
    else
      measure(arguments, *scene, view, figures);
  }
  if (arguments.what == "fit") printFit(figures);
  if (arguments.what == "masking") printMasking(figures);
  if (arguments.proves()) printProveMeans(figures);
}

}  // namespace
}  // namespace jalousie::bench

int main(int argc, char** argv) {
  using namespace jalousie::bench;
  Arguments arguments;
  GlBench bench("lv_bench",
                "Measures cost and temporal stability of levels by visibility against levels by pixel error",
                kExamples);
  addOptions(bench.options(), arguments);
  return bench.run(argc, argv, [&](nlohmann::ordered_json& figures) { measureAll(arguments, figures); });
}
