// Measures what levels by visibility save, and how stable they are, against the strongest baselines.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "gl_bench.h"
#include "lv_setup.h"

namespace jalousie::bench {
namespace {

constexpr const char* kHelp = R"(WHAT chooses the measurement:
  worth         triangles, image error and frame time at the same camera
  measures      triangles and image error for every visibility measure
  fit           triangles of --lod price at equal error, for several caps and kinds of the error, with the means over
                all views and the price that has the error of one pixel; 640x360
  calm          LOD switches on a path of 0.25 degrees per frame and under jitter, and the change that one switch makes
  calm-default  the same for the temporally stable configurations only
  masking       tolerable error of one object behind holes of 1 to 64 pixels over that behind a window, by every image
                metric, for occluders of three greys, with the range over all views; 256x256
  masking-cost  triangles and times of frames with --masking over those without
With fit and masking, a VIEW that ends in .glb or .gltf is another scene, and the next views are views of it.
VIEW is a frame of the scene's camera path, or EYE:LOOK as X,Y,Z:X,Y,Z in world units. The baselines are two-phase
culling and frustum culling with levels by pixel error. The exit code is 1 if a picture or a count is wrong.
Examples:
  lv_bench worth city.glb 300 900
      measures two frames of the camera path
  lv_bench fit city.glb 0,2,9:0,0,0 crowd.glb 300 900
      fits the constants of --lod price over two scenes
  lv_bench calm city.glb 0,2,9:0,0,0 --json calm.json
      measures one view and writes the figures
  lv_bench masking bunny.glb 0,8,30:0,4.8,0
      asks every image metric how much error a sieve hides
)";

void measure(const std::string& what, const LvView& view, nlohmann::ordered_json& figures) {
  if (what == "fit")
    measureFit(view, figures);
  else if (what == "masking")
    measureMasking(view, figures);
  else if (what == "masking-cost")
    measureMaskingCost(view, figures);
  else if (what.starts_with("calm"))
    measureCalm(view, what == "calm-default", figures);
  else
    measureWorth(view, what == "measures", figures);
}

}  // namespace
}  // namespace jalousie::bench

int main(int argc, char** argv) {
  using namespace jalousie;
  std::string what;
  std::string scene;
  std::vector<std::string> views;
  bench::GlBench bench("lv_bench",
                       "Measures cost and temporal stability of levels by visibility against levels by pixel error",
                       bench::kHelp);
  bench.options()
      .add_option("what", what, "Measurement")
      ->required()
      ->check(CLI::IsMember({"worth", "measures", "fit", "calm", "calm-default", "masking", "masking-cost"})
                  .description(""))
      ->type_name("worth|measures|fit|calm|calm-default|masking|masking-cost");
  bench.options().add_option("scene", scene, "Baked glTF or GLB file")->required()->type_name("SCENE");
  bench.options().add_option("views", views, "Frames or points")->required()->type_name("VIEW");
  return bench.run(argc, argv, [&](nlohmann::ordered_json& figures) {
    figures = nlohmann::ordered_json::array();
    auto data = std::make_unique<scene::SceneData>(scene::buildScene(asset::readSceneFile(scene)));
    for (const std::string& view : views) {
      if ((what == "fit" || what == "masking") && (view.ends_with(".glb") || view.ends_with(".gltf"))) {
        scene = view;
        data = std::make_unique<scene::SceneData>(scene::buildScene(asset::readSceneFile(scene)));
        continue;
      }
      bench::measure(what, {*data, scene, view}, figures);
    }
    if (what == "fit") bench::printFit(figures);
    if (what == "masking") bench::printMasking(figures);
  });
}
