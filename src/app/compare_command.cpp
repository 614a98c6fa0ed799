// Loads scene and path, runs the experiment, writes the report.
#include "app/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command_memory.h"
#include "app/gl_debug.h"
#include "app/path_camera.h"
#include "app/render_cameras.h"
#include "app/warnings.h"
#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "cli/program.h"
#include "compare/configuration.h"
#include "compare/experiment.h"
#include "compare/fingerprint.h"
#include "compare/frames_csv.h"
#include "compare/page.h"
#include "compare/report_folder.h"
#include "compare/summary.h"
#include "core/error.h"
#include "core/file.h"
#include "core/interruption.h"
#include "core/output_files.h"
#include "core/progress.h"
#include "core/standard_streams.h"
#include "platform/headless_context.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "visibility/importance_mask.h"

namespace jalousie::app {
namespace {

constexpr std::uint64_t kMaxProgramBytes = 1ULL << 30U;

/// The chosen configurations and what they refer to.
struct Setup {
  std::vector<compare::Configuration> configurations;
  std::deque<visibility::ImportanceMask> masks;  ///< a deque, so that the configurations' pointers stay valid
  std::vector<scene::BuildOptions> builds;       ///< of the configurations, each once
};

void setUp(const CompareOptions& options, Setup& setup) {
  for (const ConfigurationText& text : options.chosen) {
    const RenderOptions render = optionsOf(text);
    compare::Configuration configuration{
        text.name, text.options, render.frameOptions, render.rendererOptions,
        scene::BuildOptions{.patches = rowOf(render.frameOptions.detail).patches,
                            .cells = render.cells,
                            .faces = render.frameOptions.faceCulling != FaceCulling::kOff}};
    if (configuration.build.patches) configuration.build.cells = {};  // --cells has no effect on patches
    configuration.renderer.memory = options.memory;
    if (!render.importance.empty()) {
      maskNeeds(render.importance).require(options.memory, render.importance);
      configuration.renderer.importance = &setup.masks.emplace_back(asset::loadImage(render.importance));
    }
    if (std::find(setup.builds.begin(), setup.builds.end(), configuration.build) == setup.builds.end())
      setup.builds.push_back(configuration.build);
    setup.configurations.push_back(std::move(configuration));
  }
}

/// The chosen camera. Errors: kUsage if there is none.
asset::Camera chosen(const std::vector<asset::Camera>& cameras, const std::string& which,
                     const std::filesystem::path& file) {
  if (cameras.empty())
    throw Error(ErrorCode::kUsage, "has no camera; give --path, or create a path with `jalousie record`", file);
  return chosenFirst(cameras, which, file).front();
}

/// @param frames  of the camera path and of what moves
compare::Plan makePlan(const CompareOptions& options, std::uint32_t frames) {
  compare::Plan plan;
  plan.range = parseFrames(options.frames, frames);
  plan.width = options.width;
  plan.height = options.height;
  const std::map<std::string, compare::Reference> references = {
      {"none", compare::Reference::kNone}, {"lod0", compare::Reference::kLod0}, {"full", compare::Reference::kFull}};
  plan.reference = references.at(options.reference);
  plan.lead = options.lead;
  plan.keep = options.keep;
  plan.objects = options.objects;
  plan.taus = options.taus;
  plan.pixelsPerDegree = options.pixelsPerDegree;
  plan.butteraugli = options.butteraugli;
  for (std::size_t i = 0; i < options.chosen.size(); ++i)
    if (options.chosen[i].name == options.baseline) plan.baseline = i;
  return plan;
}

std::string duration(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// Progress of an experiment: one line that is redrawn on a terminal; elsewhere a new line per tenth of the work.
class RunProgress {
 public:
  RunProgress(const compare::Experiment& experiment, bool quiet)
      : experiment_(experiment),
        first_(experiment.stepsDone()),
        quiet_(quiet),
        line_("comparing", experiment.stepCount(), quiet) {}

  void update() {
    const std::size_t done = experiment_.stepsDone();
    const std::size_t count = experiment_.stepCount();
    std::string left;
    if (done > first_) {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
      left = duration(elapsed.count() / static_cast<double>(done - first_) * static_cast<double>(count - done));
    }
    line_.update(done, fmt::format("{}{}{}", experiment_.nextStep(), left.empty() ? "" : ", left: ", left));
    if (quiet_ || line_.visible() || 10 * done / count == tenths_) return;
    tenths_ = 10 * done / count;
    printError(fmt::format("jalousie: {} of {} steps done{}{}", done, count, done < count ? ", left: " : "",
                           done < count ? left : ""));
  }

 private:
  const compare::Experiment& experiment_;
  std::size_t first_;
  bool quiet_;
  Progress line_;
  std::size_t tenths_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// summary.json as text. Names can hold any bytes; what is not UTF-8 is replaced.
std::string jsonText(const nlohmann::ordered_json& summary) {
  return summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json writeReport(const CompareOptions& options, const compare::Experiment& experiment,
                                   const Setup& setup, const compare::Plan& plan,
                                   const compare::Circumstances& circumstances) {
  nlohmann::ordered_json summary =
      compare::summaryJson(experiment.results(), setup.configurations, plan, circumstances);
  writeFileAtomic(options.output / "frames.csv", compare::framesCsv(experiment.results(), setup.configurations));
  writeFileAtomic(options.output / "summary.json", jsonText(summary));
  writeFileAtomic(options.output / "index.html",
                  compare::makePage(summary, experiment.results(), setup.configurations, options.output));
  return summary;
}

/// The whole scene in view, at rest.
asset::Camera wholeScene(const CompareOptions& options, const scene::SceneData& scene) {
  const scene::Camera framed =
      scene::frameBox(scene.boundsWorld, static_cast<float>(options.width) / static_cast<float>(options.height));
  asset::Camera camera;
  camera.fovY = framed.fovY;
  camera.zNear = framed.zNear;
  camera.worldFromCamera = glm::dmat4(framed.worldFromCamera);
  return camera;
}

/// The camera of --path, else that of the scene, else one that shows a scene which moves.
asset::Camera loadPath(const CompareOptions& options, const asset::SceneFile& sceneFile,
                       const scene::SceneData& scene) {
  if (options.path.empty() && sceneFile.cameras.empty() && options.camera.empty() && !sceneFile.motion.empty())
    return wholeScene(options, scene);
  if (options.path.empty()) return chosen(sceneFile.cameras, options.camera, options.scene);
  return chosen(pathFromFile(options.path, options.memory, sceneFile.originWorld), options.camera, options.path);
}

void describeMachine(compare::Plan& plan, const gl::Capabilities& capabilities) {
  plan.renderer = capabilities.renderer;
  plan.build = compare::digestOf(readFile("/proc/self/exe", kMaxProgramBytes));
  plan.gpuTiming = !capabilities.softwareRenderer;
}

bool followsCoverage(const LodRuleRow& rule) {
  return rule.followsCoverage;
}

/// One line for each kind of levels that some configuration cannot judge.
void warnLevels(const CompareOptions& options, const Setup& setup, const scene::SceneData& scene) {
  for (const auto concerns : {&usesErrors, &followsCoverage}) {
    const auto found = std::find_if(setup.configurations.begin(), setup.configurations.end(),
                                    [&](const compare::Configuration& c) { return concerns(rowOf(c.frame.lodRule)); });
    if (found != setup.configurations.end()) warnUnknownLevels(options.scene, scene, rowOf(found->frame.lodRule));
  }
}

void warn(const CompareOptions& options, const Setup& setup, const compare::Scenes& scenes, std::uint32_t frames,
          const gl::Capabilities& capabilities) {
  if (frames == 1) warnSingleFrame(options.path.empty() ? options.scene : options.path);
  warnIgnored(options.scene, scenes.plain.ignored);
  warnLevels(options, setup, scenes.plain);
  for (std::size_t i = 0; i < setup.configurations.size(); ++i) {
    if (!setup.configurations[i].build.patches) continue;
    warnTessellationLimit(options.scene, *scenes.ofConfigurations[i], capabilities, gpu::kMaxTessellationLevel);
    break;
  }
}

/// Runs the steps that are left until all are done or a signal arrives.
void runSteps(compare::Experiment& experiment, const CompareOptions& options) {
  if (experiment.stepsDone() == 0) {
    std::error_code ignored;
    for (const char* name : {"index.html", "summary.json", "frames.csv"})
      std::filesystem::remove(options.output / name, ignored);
  }
  RunProgress progress(experiment, options.quiet);
  for (progress.update(); experiment.stepsDone() < experiment.stepCount() && !interrupted(); progress.update())
    experiment.runStep();
}

/// The scene as each configuration needs it. @param others  gets the builds that are not the plain one
compare::Scenes scenesOf(const asset::SceneFile& file, const scene::SceneData& plain, const Setup& setup,
                         std::deque<scene::SceneData>& others) {
  std::vector<const scene::SceneData*> built;
  for (const scene::BuildOptions& build : setup.builds)
    built.push_back(build == scene::BuildOptions{} ? &plain : &others.emplace_back(scene::buildScene(file, build)));
  compare::Scenes scenes{plain};
  for (const compare::Configuration& configuration : setup.configurations) {
    const auto known = std::find(setup.builds.begin(), setup.builds.end(), configuration.build);
    scenes.ofConfigurations.push_back(built[static_cast<std::size_t>(known - setup.builds.begin())]);
  }
  return scenes;
}

int compareScene(const CompareOptions& options) {
  compare::ReportFolder folder(options.output, options.resume || options.replace == Replace::kAnything);
  Setup setup;
  setUp(options, setup);
  const bool pictures = options.reference != "none";
  const std::size_t configurations = setup.configurations.size();
  const ComparisonSize comparison{.renderers = configurations + (pictures ? 1 : 0),
                                  .configurations = configurations,
                                  .builds = setup.builds,
                                  .pictures = pictures,
                                  .butteraugli = options.butteraugli,
                                  .width = options.width,
                                  .height = options.height};
  const asset::SceneFile file = readWithin(options.scene, options.memory,
                                           [&](const asset::SceneSize& size) { return compareNeeds(size, comparison); },
                                           {.observer = {}, .seconds = options.time, .plays = !options.time});
  const scene::SceneData plain = scene::buildScene(file);
  const asset::Camera path = loadPath(options, file, plain);
  const std::uint32_t frames = pathFrames({path}, file.motion.lastKey);
  compare::Plan plan = makePlan(options, frames);
  std::deque<scene::SceneData> others;
  const compare::Scenes scenes = scenesOf(file, plain, setup, others);

  const platform::HeadlessContext context(options.debug);
  const GlDebug debug(options.debug);
  describeMachine(plan, context.capabilities());
  if (!options.quiet) warn(options, setup, scenes, frames, context.capabilities());
  const std::string fingerprint = compare::experimentFingerprint(plain, path, setup.configurations, plan);
  folder.create();
  const DeferredInterruptions deferred;
  compare::Experiment experiment(
      {scenes, path, setup.configurations, plan, options.output, fingerprint, options.resume});

  runSteps(experiment, options);
  debug.check();
  if (!options.quiet) printError("jalousie: writing the report");
  const nlohmann::ordered_json summary =
      writeReport(options, experiment, setup, plan,
                  {options.scene.filename().string(), options.path.filename().string(), plan.renderer,
                   plan.gpuTiming ? "gpu" : "wall", options.command, JALOUSIE_VERSION, plain.ignored, &plain.names});
  if (options.json == kStandardOutput)
    printOutput(jsonText(summary));
  else if (!options.quiet)
    printOutput(fmt::format("{}{}\n", compare::summaryText(summary), (options.output / "index.html").string()));
  if (experiment.stepsDone() == experiment.stepCount()) return 0;
  printError(fmt::format("jalousie: {}: interrupted after {} of {} steps; the same command with --resume continues",
                         oneLine(options.output.string()), experiment.stepsDone(), experiment.stepCount()));
  return interruptionExitCode();
}

}  // namespace

int runCompare(const CompareOptions& options) {
  int result = 0;
  cli::withFile(options.scene, [&] { result = compareScene(options); });
  return result;
}

}  // namespace jalousie::app
