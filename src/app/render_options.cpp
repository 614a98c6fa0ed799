// Declaration and checks of the options of `jalousie render`.
#include "app/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace jalousie::app {
namespace {

/// Turns "1,2.5,-3" into a point; anything else is a usage error that CLI11 reports.
bool parsePoint(const CLI::results_t& results, std::optional<glm::vec3>& target) {
  std::array<float, 3> values = {};
  std::string_view text = results.at(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return false;
    if (!CLI::detail::lexical_cast(std::string(text.substr(0, comma)), values[k]) || !std::isfinite(values[k]))
      return false;
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  target = glm::vec3(values[0], values[1], values[2]);
  return true;
}

bool parseSize(const CLI::results_t& results, RenderOptions& options) {
  const std::string& text = results.at(0);
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return false;
  return CLI::detail::lexical_cast(text.substr(0, cross), options.width) &&
         CLI::detail::lexical_cast(text.substr(cross + 1), options.height) && options.width >= 1 &&
         options.height >= 1 && options.width <= 16384 && options.height <= 16384;
}

void addPoint(CLI::App& command, const char* name, std::optional<glm::vec3>& target, const char* help) {
  command
      .add_option(
          name, [&target](const CLI::results_t& results) { return parsePoint(results, target); }, help)
      ->type_name("X,Y,Z");
}

void addCameraOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--frame", options.frame, "Frame of the scene's camera path, 30 a second")
      ->check(CLI::NonNegativeNumber);
  addPoint(command, "--eye", options.eye, "Camera position, world units; needs --look");
  addPoint(command, "--look", options.look, "Point the camera looks at");
  command.add_option("--freeze-frame", options.freezeFrame, "Cull from this frame's camera, draw from the other one")
      ->check(CLI::NonNegativeNumber);
  addPoint(command, "--freeze-eye", options.freezeEye,
           "Cull from this position, draw from the other camera; needs --freeze-look");
  addPoint(command, "--freeze-look", options.freezeLook, "Point the frozen culling camera looks at");
  command
      .add_option(
          "--size", [&options](const CLI::results_t& results) { return parseSize(results, options); },
          "Image size in pixels, up to 16384 a side [1280x720]")
      ->type_name("WxH");
}

void addMethodOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--mode", options.mode, "Culling: full = none, frustum, hom = hierarchical occlusion map")
      ->check(CLI::IsMember({"full", "frustum", "hom"}))
      ->capture_default_str();
  command
      .add_option("--lod", options.lod,
                  "Detail: finest, linear = by level of visibility [linear with hom, else finest]")
      ->check(CLI::IsMember({"finest", "linear"}));
  command.add_option("--lv", options.lv, "Measure of hiddenness")
      ->check(CLI::IsMember({"thesis"}))
      ->capture_default_str();
  command
      .add_option("--detail", options.detail,
                  "discrete = LOD chain, tessellation = Phong patches over the coarsest level")
      ->check(CLI::IsMember({"discrete", "tessellation"}))
      ->capture_default_str();
  command.add_option("--max-tessellation", options.frameOptions.maxTessellation, "Finest tessellation level")
      ->check(CLI::Range(1U, gpu::kMaxTessellationLevel))
      ->capture_default_str();
  command
      .add_option("--occluder-distance", options.frameOptions.occluderDistance,
                  "Objects nearer than this are occluders, world units [distance to the scene + 12 % of its diagonal]")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--cull-threshold", options.frameOptions.cullThreshold,
                  "Opacity from which a texel of the map hides; below 1 visible pixels can be lost")
      ->check(CLI::Range(0.01F, 1.0F))
      ->capture_default_str();
}

void addOutputOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--view", options.view,
                  "shaded, lod = occluders red, occludees blue, lighter = coarser; lv = heat map; "
                  "occlusion = the map itself")
      ->check(CLI::IsMember({"shaded", "lod", "lv", "occlusion"}))
      ->capture_default_str();
  command.add_option("--map-level", options.frameOptions.mapLevel, "Level that --view occlusion shows")
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Image to write")->type_name("OUT.png");
  command.add_option("--json", options.json, "Write statistics as JSON; - for standard output")->type_name("STATS");
  command
      .add_option("--repeat", options.repeat, "Render N times after one warm-up and report median times; 1: no warm-up")
      ->check(CLI::Range(1U, 10000U))
      ->capture_default_str();
  command.add_flag("--stats-only", options.statsOnly, "Run the visibility passes only; no picture");
  command.add_flag("-q,--quiet", options.quiet, "No summary on standard output");
}

[[noreturn]] void refuse(const char* reason) {
  throw Error(ErrorCode::kUsage, reason);
}

gpu::uint indexOf(std::initializer_list<const char*> names, const std::string& name) {
  gpu::uint index = 0;
  for (const char* candidate : names) {
    if (name == candidate) return index;
    ++index;
  }
  return index;
}

void checkCamera(const RenderOptions& o) {
  if (o.eye.has_value() != o.look.has_value()) refuse("--eye and --look go together");
  if (o.eye && o.frame) refuse("choose either --frame or --eye and --look");
  if (o.freezeEye.has_value() != o.freezeLook.has_value()) refuse("--freeze-eye and --freeze-look go together");
  if (o.freezeEye && o.freezeFrame) refuse("choose either --freeze-frame or --freeze-eye and --freeze-look");
}

void checkCombination(const RenderOptions& o) {
  const bool hom = o.mode == "hom";
  if (!hom && o.lod == "linear") refuse("--lod linear needs the occlusion map of --mode hom");
  if (!hom && (o.view == "occlusion" || o.view == "lv")) refuse("--view occlusion and lv need the map of --mode hom");
  if (!hom && o.frameOptions.occluderDistance) refuse("--occluder-distance needs --mode hom");
  if (!hom && o.frameOptions.cullThreshold < 1.0F) refuse("--cull-threshold needs --mode hom");
  if (o.frameOptions.mapLevel != 0 && o.view != "occlusion") refuse("--map-level needs --view occlusion");
  if (o.detail != "tessellation" && o.frameOptions.maxTessellation != gpu::kMaxTessellationLevel)
    refuse("--max-tessellation needs --detail tessellation");
  if (o.output.empty() && !o.statsOnly) refuse("say where the image goes (-o OUT.png), or --stats-only");
  if (!o.output.empty() && o.statsOnly) refuse("--stats-only draws no image; leave out -o");
}

}  // namespace

void RenderOptions::finish() {
  checkCamera(*this);
  checkCombination(*this);
  if (lod.empty()) lod = mode == "hom" ? "linear" : "finest";
  frameOptions.cullMode = indexOf({"full", "frustum", "hom"}, mode);
  frameOptions.lodRule = indexOf({"finest", "linear"}, lod);
  frameOptions.detail = indexOf({"discrete", "tessellation"}, detail);
  frameOptions.view = indexOf({"shaded", "lod", "lv", "occlusion"}, view);
  frameOptions.skipDraw = statsOnly;
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("scene", options.scene, "glTF or GLB file, baked or plain")->required()->type_name("SCENE.glb");
  addCameraOptions(command, options);
  addMethodOptions(command, options);
  addOutputOptions(command, options);
  command.footer(R"(Examples:
  jalousie render scene.glb -o frame.png
      the thesis' pipeline from the start of the scene's camera path
  jalousie render scene.glb --frame 900 --view lod --json stats.json -o lod.png
      which level every object got, and the figures
  jalousie render scene.glb --freeze-frame 0 --eye 0,40,-90 --look 0,0,0 --view lod -o behind.png
      what the camera at frame 0 left over, seen from behind
  jalousie render scene.glb --mode frustum --stats-only --json -
      triangles without occlusion culling, no picture)");
}

}  // namespace jalousie::app
