// Declaration and checks of the options of `jalousie render`.
#include "app/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>
#include <vector>

#include "app/option_checks.h"
#include "app/option_values.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

const std::vector<std::string> kModes = {"full", "frustum", "hom", "hom-depth", "hiz"};
const std::vector<std::string> kLodRules = {"finest", "linear", "pixel-error", "lv-error"};
const std::vector<std::string> kMeasures = {"none", "thesis", "spectral", "chord", "coverage", "pixels"};
const std::vector<std::string> kViews = {"shaded", "lod", "lv", "occlusion", "phase"};
const std::vector<std::string> kDetails = {"discrete", "tessellation"};

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
  addSize(command, options.width, options.height);
}

void addOutputOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--view", options.view,
                  "shaded, lod = occluders red, others blue, lighter = coarser; lv = heat map; occlusion = the map or "
                  "depth pyramid itself; phase = drawn before the test grey, after it orange, before it in vain red")
      ->check(CLI::IsMember(kViews))
      ->capture_default_str();
  command.add_option("--map-level", options.frameOptions.mapLevel, "Level that --view occlusion shows")
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Image to write")->type_name("OUT.png");
  command.add_option("--json", options.json, "Write statistics as JSON; - for standard output")->type_name("STATS");
  command
      .add_option("--repeat", options.repeat, "Render N times after one warm-up and report median times; 1: no warm-up")
      ->check(CLI::Range(1U, 10000U))
      ->capture_default_str();
  command
      .add_option_function<std::uint32_t>(
          "--settle",
          [&options](const std::uint32_t& frames) {
            options.settle = frames;
            options.settleGiven = true;
          },
          "With --mode hiz or --lv pixels, frames from the same camera before the picture; 0 shows the first frame "
          "after "
          "a cut [2]")
      ->check(CLI::Range(0U, 1000U));
  command.add_flag("--stats-only", options.statsOnly, "Run the visibility passes only; no picture");
  command.add_flag("-q,--quiet", options.quiet, "No summary on standard output");
}

[[noreturn]] void refuse(const char* reason) {
  throw Error(ErrorCode::kUsage, reason);
}

gpu::uint indexOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<gpu::uint>(std::find(names.begin(), names.end(), name) - names.begin());
}

void checkCamera(const RenderOptions& o) {
  if (o.eye.has_value() != o.look.has_value()) refuse("--eye and --look go together");
  if (o.eye && o.frame) refuse("choose either --frame or --eye and --look");
  if (o.freezeEye.has_value() != o.freezeLook.has_value()) refuse("--freeze-eye and --freeze-look go together");
  if (o.freezeEye && o.freezeFrame) refuse("choose either --freeze-frame or --freeze-eye and --freeze-look");
}

void checkCombination(const RenderOptions& o) {
  const bool map = o.mode == "hom" || o.mode == "hom-depth";
  const bool twoPhases = o.mode == "hiz";
  const bool followsLv = o.lod == "linear" || o.lod == "lv-error";
  const bool counts = o.lv == "pixels";
  const bool usesLv = followsLv || o.view == "lv";
  if (!map && !twoPhases && usesLv && !counts)
    refuse("--lod linear, lv-error and --view lv need --mode hom, hom-depth or hiz, or --lv pixels");
  if (o.lod != "lv-error" && o.relaxGiven) refuse("--relax needs --lod lv-error");
  if (o.lv != "none" && !usesLv) refuse("--lv needs --lod linear, --lod lv-error or --view lv");
  if (!map && !twoPhases && o.view == "occlusion") refuse("--view occlusion needs --mode hom, hom-depth or hiz");
  if (!twoPhases && o.view == "phase") refuse("--view phase needs --mode hiz");
  if (!map && o.frameOptions.occluderDistance) refuse("--occluder-distance needs --mode hom or hom-depth");
  if (!map && o.frameOptions.occluderTau) refuse("--occluder-tau needs --mode hom or hom-depth");
  if (!map && o.frameOptions.cullThreshold < 1.0F) refuse("--cull-threshold needs --mode hom or hom-depth");
  if (!twoPhases && !(usesLv && counts) && o.settleGiven) refuse("--settle needs --mode hiz or --lv pixels");
  if (o.frameOptions.calm && o.lod != "pixel-error" && o.lod != "lv-error")
    refuse("--calm needs --lod pixel-error or lv-error");
  if (o.lod != "pixel-error" && o.lod != "lv-error" && o.tauGiven) refuse("--tau needs --lod pixel-error or lv-error");
  if (o.mode == "full" && o.frameOptions.minPixels > 0.0F) refuse("--min-pixels culls; --mode full does not");
  if (o.frameOptions.mapLevel != 0 && o.view != "occlusion") refuse("--map-level needs --view occlusion");
  if (o.detail != "tessellation" && o.frameOptions.maxTessellation != gpu::kMaxTessellationLevel)
    refuse("--max-tessellation needs --detail tessellation");
  if (o.output.empty() && !o.statsOnly) refuse("say where the image goes (-o OUT.png), or --stats-only");
  if (!o.output.empty() && o.statsOnly) refuse("--stats-only draws no image; leave out -o");
}

}  // namespace

void addMethodOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--mode", options.mode,
                  "Culling: full = none, frustum, hom = hierarchical occlusion map as in the thesis, hom-depth = the "
                  "same where the occluders are in front, hiz = two phases against depth, never hides what can be seen")
      ->check(CLI::IsMember(kModes))
      ->capture_default_str();
  command
      .add_option("--lod", options.lod,
                  "Detail: finest, linear = by level of visibility, pixel-error = coarsest level within --tau, "
                  "lv-error = the same, relaxed where the object is hidden")
      ->check(CLI::IsMember(kLodRules))
      ->capture_default_str();
  command
      .add_option_function<float>(
          "--tau",
          [&options](const float& tau) {
            options.frameOptions.tau = tau;
            options.tauGiven = true;
          },
          "Error that --lod pixel-error and lv-error allow, pixels [1]")
      ->check(inRange(0.0, 1000.0));
  command
      .add_option("--min-pixels", options.frameOptions.minPixels,
                  "Contribution culling: leave out objects whose rectangle covers fewer pixels; 0 = none")
      ->check(inRange(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option(
          "--importance", options.importance,
          "Grey image stretched over the screen: white keeps --tau and --min-pixels, darker divides by its value, "
          "down to 1/16")
      ->type_name("MASK.png");
  command
      .add_option(
          "--lv", options.lv,
          "Measure of hiddenness: thesis = level of visibility, spectral = how finely divided the opening is, "
          "chord = how short its mean chord, coverage = covered share alone, pixels = counted in the last frame, "
          "none [linear: thesis, lv-error and --view lv: pixels]")
      ->check(CLI::IsMember(kMeasures));
  command
      .add_option_function<float>(
          "--relax",
          [&options](const float& relax) {
            options.frameOptions.relax = relax;
            options.relaxGiven = true;
          },
          "With --lod lv-error, tau grows with (visible share)^(-1/4), up to 1 + RELAX times [64]")
      ->check(inRange(0.0, 1000.0));
  command.add_flag(
      "--calm", options.frameOptions.calm,
      "Levels keep within a margin of the budget, change one at a time and are cross-faded, as in a moving "
      "picture; without it they follow from the view alone");
  command
      .add_option("--detail", options.detail,
                  "discrete = LOD chain, tessellation = Phong patches over the coarsest level")
      ->check(CLI::IsMember(kDetails))
      ->capture_default_str();
  command.add_option("--max-tessellation", options.frameOptions.maxTessellation, "Finest tessellation level")
      ->check(CLI::Range(1U, gpu::kMaxTessellationLevel))
      ->capture_default_str();
  command
      .add_option("--occluder-distance", options.frameOptions.occluderDistance,
                  "Objects nearer than this are occluders, world units [distance to the scene + 12 % of its diagonal]")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--occluder-tau", options.frameOptions.occluderTau,
                  "Error of the levels drawn into the occlusion map, pixels [hom: 0, hom-depth: 0.5]")
      ->check(inRange(0.0, 1000.0));
  command
      .add_option("--cull-threshold", options.frameOptions.cullThreshold,
                  "Opacity from which a texel of the map hides; below 1 visible pixels can be lost")
      ->check(inRange(0.01, 1.0))
      ->capture_default_str();
  command
      .add_option("--draws", options.draws,
                  "instanced = one command per mesh and level, per-object = one per object; same image")
      ->check(CLI::IsMember({"instanced", "per-object"}))
      ->capture_default_str();
  command
      .add_option("--capacity", options.rendererOptions.capacity,
                  "Most objects one draw list holds; more are left out, counted and reported [all]")
      ->check(CLI::PositiveNumber);
  command.add_flag("--core", options.coreOnly, "OpenGL 4.5 core only, no extension; same image");
}

void RenderOptions::finish() {
  if (lv.empty()) lv = lod == "linear" ? "thesis" : lod == "lv-error" || view == "lv" ? "pixels" : "none";
  checkCamera(*this);
  checkCombination(*this);
  frameOptions.cullMode = indexOf(kModes, mode);
  frameOptions.lodRule = indexOf(kLodRules, lod);
  frameOptions.lvMeasure = indexOf(kMeasures, lv);
  frameOptions.detail = indexOf(kDetails, detail);
  frameOptions.view = indexOf(kViews, view);
  frameOptions.skipDraw = statsOnly;
  rendererOptions.submission =
      draws == "instanced" ? visibility::Submission::kInstanced : visibility::Submission::kPerObject;
  rendererOptions.fastPaths = !coreOnly;
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("scene", options.scene, "glTF or GLB file, baked or plain")->required()->type_name("SCENE.glb");
  addCameraOptions(command, options);
  addMethodOptions(command, options);
  addOutputOptions(command, options);
  command.footer(R"(Examples:
  jalousie render scene.glb -o frame.png
      two-phase culling and levels within one pixel of error, from the start of the scene's camera path
  jalousie render scene.glb --frame 900 --mode hom --lod linear --view lod --json stats.json -o lod.png
      the thesis' pipeline: which level every object got, and the figures
  jalousie render scene.glb --freeze-frame 0 --eye 0,40,-90 --look 0,0,0 -o behind.png
      what the camera at frame 0 left over, seen from behind
  jalousie render scene.glb --mode frustum --stats-only --json -
      triangles without occlusion culling, no picture
  jalousie render scene.glb --settle 0 --view phase -o cut.png
      the frame after a cut: what went into it before the test, and what only after it
  jalousie render scene.glb --tau 2 --min-pixels 4 --importance mask.png -o cheap.png
      a smaller budget, least where the mask is dark
)");
}

}  // namespace jalousie::app
