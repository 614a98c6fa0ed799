// Scene in, frame out.
#include "app/render_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "app/render_report.h"
#include "app/warnings.h"
#include "asset/image_io.h"
#include "core/error.h"
#include "core/file.h"
#include "core/progress.h"
#include "platform/headless_context.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::app {
namespace {

scene::Camera pathCamera(const scene::SceneData& scene, float frame, const std::filesystem::path& file) {
  if (scene.cameras.empty())
    throw Error(ErrorCode::kUsage, "the scene has no camera; say --eye and --look instead of a frame", file);
  const std::uint32_t frames = scene::frameCount(scene.cameras.front());
  if (frame > static_cast<float>(frames - 1))
    throw Error(ErrorCode::kUsage, fmt::format("frame {} is beyond the camera path (0..{})", frame, frames - 1), file);
  return scene::cameraAtFrame(scene.cameras.front(), frame);
}

scene::Camera drawCamera(const RenderOptions& options, const scene::SceneData& scene) {
  if (options.eye) return scene::lookAt(*options.eye, *options.look, scene.boundsWorld);
  if (options.frame || !scene.cameras.empty()) return pathCamera(scene, options.frame.value_or(0.0F), options.scene);
  return scene::frameBox(scene.boundsWorld, static_cast<float>(options.width) / static_cast<float>(options.height));
}

scene::Camera cullCamera(const RenderOptions& options, const scene::SceneData& scene, const scene::Camera& drawn) {
  if (options.freezeEye) return scene::lookAt(*options.freezeEye, *options.freezeLook, scene.boundsWorld);
  if (options.freezeFrame) return pathCamera(scene, *options.freezeFrame, options.scene);
  return drawn;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Frames before the measured ones: until the visible set of two phases has settled (the first frame knows nothing, the
/// second draws all that the first one let through) and their pixels are counted, and one more to warm caches up if
/// times are wanted.
std::uint32_t warmUpFrames(const RenderOptions& options) {
  return (options.mode == "hiz" || options.lv == "pixels" ? options.settle : 0U) + (options.repeat > 1 ? 1U : 0U);
}

/// Renders options.repeat frames after the warm-up and takes medians per pass, scaled by how often it ran.
FrameTimes renderFrames(const RenderOptions& options, render::FrameRenderer& renderer, gl::Timing timing,
                        const scene::Camera& cull, const scene::Camera& draw) {
  const std::uint32_t warmUps = warmUpFrames(options);
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> samples;
  renderer.timer().setTiming(timing);
  Progress progress("rendering", options.repeat + warmUps, options.quiet);
  for (std::uint32_t i = 0; i < options.repeat + warmUps; ++i) {
    progress.update(i);
    renderer.render(options.frameOptions, cull, draw);
    if (i < warmUps) continue;
    for (const gl::PassTime& pass : renderer.timer().passes()) {
      std::vector<double>& times = samples[std::string(pass.name)];
      if (times.empty()) order.emplace_back(pass.name);
      times.push_back(pass.ms);
    }
  }
  FrameTimes times;
  for (const std::string& name : order) {
    // Some passes do not run in every frame.
    const double share = static_cast<double>(samples[name].size()) / options.repeat;
    times.passes.emplace_back(name, share * median(samples[name]));
    times.frameMs += times.passes.back().second;
  }
  return times;
}

void writeReport(const RenderOptions& options, const RenderReport& report) {
  if (options.json == "-") {
    fmt::print("{}", reportJson(options, report));
  } else {
    if (!options.json.empty()) writeFileAtomic(options.json, reportJson(options, report));
    if (!options.quiet) fmt::print("{}", reportText(options, report));
  }
}

}  // namespace

void runRender(const RenderOptions& options) {
  const asset::SceneFile file = asset::readSceneFile(options.scene);
  const scene::SceneData scene =
      scene::buildScene(file, {.patches = options.frameOptions.detail == gpu::kDetailTessellation});
  const scene::Camera draw = drawCamera(options, scene);
  const scene::Camera cull = cullCamera(options, scene, draw);

  const platform::HeadlessContext context(/*debug=*/false);
  std::optional<visibility::ImportanceMask> importance;
  if (!options.importance.empty()) importance.emplace(asset::loadImage(options.importance));
  render::RendererOptions rendererOptions = options.rendererOptions;
  rendererOptions.importance = importance ? &*importance : nullptr;
  render::FrameRenderer renderer(scene, options.width, options.height, rendererOptions);
  RenderReport report;
  report.renderer = context.capabilities().renderer;
  report.gpuTiming = !context.capabilities().softwareRenderer;
  report.times = renderFrames(options, renderer, report.gpuTiming ? gl::Timing::kGpu : gl::Timing::kWall, cull, draw);
  report.statistics = renderer.readStatistics();
  report.maxTessellation = renderer.cullView().maxTessellation;
  if (options.detail == "tessellation")
    warnTessellationLimit(options.scene, scene, context.capabilities(), options.frameOptions.maxTessellation);
  if (report.statistics.dropped > 0)
    fmt::print(stderr, "jalousie: warning: {}: {} objects found no room in a draw list of {} and are missing\n",
               options.scene.string(), report.statistics.dropped, options.rendererOptions.capacity.value_or(0));
  const bool followsError = options.lod == "pixel-error" || options.lod == "lv-error";
  if (scene.hasUnmeasuredLevels && followsError && !options.quiet) warnUnmeasuredLevels(options.scene);
  if (!options.statsOnly) asset::savePng(renderer.readImage(), options.output);
  writeReport(options, report);
}

}  // namespace jalousie::app
