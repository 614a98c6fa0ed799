// Declaration and checks of the options of `jalousie render`.
#include "app/render_command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/option_values.h"
#include "app/path_camera.h"
#include "app/render_option_table.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/option_checks.h"
#include "core/error.h"
#include "policy/table.h"
#include "scene/camera.h"

namespace jalousie::app {
namespace {

void addOutputOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("-o,--output", options.output, "Write the image to this file")->type_name("OUT.png");
  command.add_option("--json", options.json, "Write statistics as JSON to this file; - for standard output")
      ->type_name("STATS");
  command
      .add_option("--repeat", options.repeat,
                  "Render N times after one warm-up frame and report median times; with 1 there is no warm-up")
      ->check(cli::inRange(1, 10000).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--stats-only", options.statsOnly, "Run the culling passes only and draw no picture");
  command.add_flag("-q,--quiet", options.quiet, "Print no summary and no warnings");
}

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorCode::kUsage, reason);
}

void checkCamera(const RenderOptions& o) {
  if (o.eye.has_value() != o.look.has_value()) refuse("--eye and --look go together");
  if (o.eye && o.frame) refuse("choose either --frame or --eye and --look");
  if (o.eye && !o.camera.empty()) refuse("choose either --camera or --eye and --look");
  if (o.freezeEye.has_value() != o.freezeLook.has_value()) refuse("--freeze-eye and --freeze-look go together");
  if (o.freezeEye && o.freezeFrame) refuse("choose either --freeze-frame or --freeze-eye and --freeze-look");
}

void checkCombination(const RenderOptions& o) {
  const FramePolicy& policy = o.frameOptions;
  if (o.frameOptions.triangleBudget > 0 && !(o.frameOptions.tau > 0.0F))
    refuse("--triangles needs a --tau above 0: at 0 every error costs more than any triangle");
  const ViewRow& view = rowOf(policy.view);
  const std::string testing = policy::namesWith(cullModeTable(), &CullModeRow::testsOcclusion);
  const bool tests = rowOf(policy.cullMode).testsOcclusion;
  if (!tests && wantsBlock(policy)) {
    refuse(fmt::format("--lod {} and --view {} need --mode {}, or --lv {}",
                       policy::namesWith(lodRuleTable(), &LodRuleRow::followsLv),
                       policy::namesWith(viewTable(), &ViewRow::showsLv), testing,
                       policy::namesWith(lvMeasureTable(), &LvMeasureRow::countsPixels)));
  }
  if (!tests && view.needsOcclusionTest) refuse(fmt::format("--view {} needs --mode {}", view.name, testing));
  if (!rowOf(policy.cullMode).twoPhases && view.needsTwoPhases)
    refuse(fmt::format("--view {} needs --mode {}", view.name,
                       policy::namesWith(cullModeTable(), &CullModeRow::twoPhases)));
  for (const RenderOption& option : renderOptionTable())
    if (isSet(option, o) && !applies(option, o)) refuse(fmt::format("{} needs {}", option.name, option.needs));
}

void checkOutput(const RenderOptions& o) {
  if (o.output.empty() && !o.statsOnly) refuse("say where the image goes (-o OUT.png), or --stats-only");
  if (!o.output.empty() && o.statsOnly) refuse("--stats-only draws no image; leave out -o");
}

}  // namespace

void addCameraOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("--path", options.path, "Take the camera path from this glTF file [the scene's own]")
      ->type_name("PATH.glb");
  addCameraOption(command, options.camera);
  addTimeOption(command, options.time);
  const CLI::Validator notNegative = cli::inRange(0.0, 1e9).description("");
  command
      .add_option("--frame", options.frame,
                  "Render this frame of the camera path and of the scene's animations (30 frames per second)")
      ->check(notNegative)
      ->type_name("FRAME");
  addPoint(command, "--eye", options.eye, "Place the camera here, world units; needs --look");
  addPoint(command, "--look", options.look, "Point the camera at this point, world units");
  command
      .add_option("--freeze-frame", options.freezeFrame,
                  "Cull from the camera of this frame; draw from the other camera")
      ->check(notNegative)
      ->type_name("FRAME");
  addPoint(command, "--freeze-eye", options.freezeEye,
           "Cull from this position, world units; draw from the other camera; needs --freeze-look");
  addPoint(command, "--freeze-look", options.freezeLook, "Point the culling camera at this point, world units");
  addSize(command, options.width, options.height);
}

void addPictureOptions(CLI::App& command, RenderOptions& options) {
  for (const RenderOption& option : renderOptionTable())
    if (option.group == OptionGroup::kView) addToCommandLine(command, option, options);
}

void addMethodOptions(CLI::App& command, RenderOptions& options) {
  for (const RenderOption& option : renderOptionTable())
    if (option.group != OptionGroup::kView) addToCommandLine(command, option, options);
}

void RenderOptions::finish() {
  checkOutput(*this);
  finishFrame();
}

void RenderOptions::finishFrame() {
  frameOptions.lvMeasure = lv.value_or(defaultMeasure(frameOptions));
  checkCamera(*this);
  checkCombination(*this);
  frameOptions.skipDraw = statsOnly;
  frameOptions.seconds = scene::secondsAt(frame.value_or(0.0F));
  rendererOptions.fastPaths = !coreOnly;
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("scene", options.scene, "glTF or GLB file, with or without LODs")
      ->required()
      ->type_name("SCENE.glb");
  addCameraOptions(command, options);
  addMethodOptions(command, options);
  addPictureOptions(command, options);
  addOutputOptions(command, options);
  cli::addForceOption(command, options.replace);
  cli::addMemoryOption(command, options.memory);
  command.footer(R"(Examples:
  jalousie render scene.glb -o frame.png
      default: two-phase culling, levels at one price, start of the scene's camera path
  jalousie render scene.glb --frame 900 --mode hom --lod linear --view lod --json stats.json -o lod.png
      the method of the thesis: LOD of every object as a picture, statistics as JSON
  jalousie render scene.glb --freeze-frame 0 --eye 0,40,-90 --look 0,0,0 -o behind.png
      what remains after culling from the camera of frame 0, seen from behind
  jalousie render scene.glb --mode frustum --stats-only --json -
      count triangles without occlusion culling; no picture
  jalousie render scene.glb --settle 0 --view phase -o cut.png
      first frame after a camera cut: objects by the phase that drew them
  jalousie render scene.glb --tau 2 --min-pixels 4 --importance mask.png -o cheap.png
      screen-space error of two pixels, more where the mask is dark
  jalousie render scene.glb --triangles 200000 --settle 60 -o budget.png
      the best picture with 200,000 triangles
  jalousie render scene.glb --tau 4 --max-error 2 -o coarse.png
      four times the usual scale, but no deviation of more than two pixels
)");
}

}  // namespace jalousie::app
