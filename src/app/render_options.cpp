// Declaration and checks of the options of `jalousie render`.
#include "app/render_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/option_checks.h"
#include "app/option_values.h"
#include "app/render_option_table.h"
#include "core/error.h"
#include "policy/table.h"

namespace jalousie::app {
namespace {

void addOutputOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("-o,--output", options.output, "Image to write")->type_name("OUT.png");
  command.add_option("--json", options.json, "Write statistics as JSON; - for standard output")->type_name("STATS");
  command
      .add_option("--repeat", options.repeat, "Render N times after one warm-up and report median times; 1: no warm-up")
      ->check(inRange(1, 10000).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--stats-only", options.statsOnly, "Run the visibility passes only; no picture");
  command.add_flag("-q,--quiet", options.quiet, "No summary on standard output");
}

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorCode::kUsage, reason);
}

void checkCamera(const RenderOptions& o) {
  if (o.eye.has_value() != o.look.has_value()) refuse("--eye and --look go together");
  if (o.eye && o.frame) refuse("choose either --frame or --eye and --look");
  if (o.freezeEye.has_value() != o.freezeLook.has_value()) refuse("--freeze-eye and --freeze-look go together");
  if (o.freezeEye && o.freezeFrame) refuse("choose either --freeze-frame or --freeze-eye and --freeze-look");
}

void checkCombination(const RenderOptions& o) {
  const FramePolicy& policy = o.frameOptions;
  const ViewRow& view = rowOf(policy.view);
  const std::string testing = policy::namesWith(cullModeTable(), &CullModeRow::testsOcclusion);
  const bool tests = rowOf(policy.cullMode).testsOcclusion;
  if (!tests && wantsBlock(policy))
    refuse(fmt::format("--lod linear, lv-error and --view lv need --mode {}, or --lv pixels", testing));
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
  command.add_option("--path", options.path, "glTF whose camera path --frame follows [the scene's own]")
      ->type_name("PATH.glb");
  const CLI::Validator notNegative = inRange(0.0, 1e9).description("");
  command.add_option("--frame", options.frame, "Frame of the camera path, 30 a second")
      ->check(notNegative)
      ->type_name("FRAME");
  addPoint(command, "--eye", options.eye, "Camera position, world units; needs --look");
  addPoint(command, "--look", options.look, "Point the camera looks at");
  command.add_option("--freeze-frame", options.freezeFrame, "Cull from this frame's camera, draw from the other one")
      ->check(notNegative)
      ->type_name("FRAME");
  addPoint(command, "--freeze-eye", options.freezeEye,
           "Cull from this position, draw from the other camera; needs --freeze-look");
  addPoint(command, "--freeze-look", options.freezeLook, "Point the frozen culling camera looks at");
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
  rendererOptions.fastPaths = !coreOnly;
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("scene", options.scene, "glTF or GLB file, baked or plain")->required()->type_name("SCENE.glb");
  addCameraOptions(command, options);
  addMethodOptions(command, options);
  addPictureOptions(command, options);
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
