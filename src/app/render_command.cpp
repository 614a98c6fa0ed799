// Runs `jalousie render`: reads the scene, renders, writes picture and statistics.
#include "app/render_command.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "app/capture.h"
#include "app/command_memory.h"
#include "app/gl_debug.h"
#include "app/shown_objects.h"
#include "app/warnings.h"
#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "cli/program.h"
#include "compare/frame_objects.h"
#include "core/error.h"
#include "core/output_files.h"
#include "core/progress.h"
#include "core/standard_streams.h"
#include "platform/headless_context.h"
#include "render/frame_renderer.h"
#include "scene/scene_data.h"
#include "visibility/importance_mask.h"

namespace jalousie::app {
namespace {

void writeReport(const RenderOptions& options, const RenderReport& report) {
  if (!options.json.empty()) writeText(options.json, reportJson(options, report));
  if (options.json != kStandardOutput && !options.quiet) printOutput(reportText(options, report));
}

/// The file itself is gone afterwards.
scene::SceneData loadScene(const RenderOptions& options) {
  const asset::SceneFile file = readWithin(
      options.scene, options.memory, [&](const asset::SceneSize& size) { return renderNeeds(size, options); },
      {.observer = {}, .seconds = options.time, .plays = playsAnimations(options)});
  return scene::buildScene(file, buildOptionsOf(file, options));
}

void render(const RenderOptions& options) {
  checkOutputs(std::vector<NamedFile>{{"-o", options.output, OutputKind::kPicture},
                                      {"--json", options.json, OutputKind::kReport, true}},
               std::vector{options.scene, options.path, options.importance}, options.replace);
  scene::SceneData scene = loadScene(options);
  const RenderCameras cameras = renderCameras(options, scene, pathCameras(options, scene));

  const platform::HeadlessContext context(options.debug);
  const GlDebug debug(options.debug);
  std::optional<visibility::ImportanceMask> importance;
  if (!options.importance.empty()) importance.emplace(asset::loadImage(options.importance));
  render::RendererOptions rendererOptions = options.rendererOptions;
  rendererOptions.importance = importance ? &*importance : nullptr;
  rendererOptions.memory = options.memory;
  render::FrameRenderer renderer(scene, options.width, options.height, rendererOptions);
  renderer.prepare(options.frameOptions);
  scene.textures.images = {};  // uploaded
  RenderReport report = [&] {
    Progress progress("rendering", captureFrames(options), options.quiet);
    return captureFrame(options, renderer, context.capabilities(), cameras,
                        [&](std::uint32_t frame) { progress.update(frame); });
  }();
  if (!scene.motion.empty())
    report.seconds = static_cast<double>(options.frame.value_or(0.0F)) / static_cast<double>(scene::kPathRate);
  report.points = scene.loose.points();
  report.segments = scene.loose.segments();
  report.ignored = scene.ignored;
  if (!options.quiet) warnIgnored(options.scene, scene.ignored);
  if (rowOf(options.frameOptions.detail).patches)
    warnTessellationLimit(options.scene, scene, context.capabilities(), options.frameOptions.maxTessellation);
  if (report.statistics.dropped > 0) {
    printError(fmt::format("jalousie: warning: {}: {} {} found no room in a draw list of {} and are missing",
                           oneLine(options.scene.string()), report.statistics.dropped,
                           scene.cells.objects.empty() ? "objects" : "cells of objects",
                           options.rendererOptions.capacity.value_or(0)));
  }
  if (!options.quiet)
    warnTriangleBudget(options.scene, options.frameOptions.triangleBudget, report.statistics, options.settle);
  if (!options.quiet) warnUnknownLevels(options.scene, scene, rowOf(options.frameOptions.lodRule));
  if (!options.statsOnly) asset::savePng(renderer.readImage(), options.output);
  const bool ownView = !options.freezeFrame && !options.freezeEye;
  if (!options.statsOnly && ownView && (!options.json.empty() || !options.quiet)) {
    const compare::FrameObjects objects = compare::countObjects(renderer);
    report.visible = objects.visible;
    report.wrongPixels = objects.wrongPixels;
  }
  debug.check();
  writeReport(options, report);
}

}  // namespace

void runRender(const RenderOptions& options) {
  cli::withFile(options.scene, [&] { render(options); });
}

}  // namespace jalousie::app
