// Warm-up, repeats, medians.
#include "app/capture.h"

#include <map>
#include <string>
#include <vector>

#include "core/median.h"

namespace jalousie::app {
namespace {

/// Frames before the measured ones: until the visible set of two phases has settled (the first frame knows nothing, the
/// second draws all that the first one let through) and their pixels are counted, and one more to warm caches up if
/// times are wanted.
std::uint32_t warmUpFrames(const RenderOptions& options) {
  return (dependsOnHistory(options.frameOptions) ? options.settle : 0U) + (options.repeat > 1 ? 1U : 0U);
}

}  // namespace

std::uint32_t captureFrames(const RenderOptions& options) {
  return options.repeat + warmUpFrames(options);
}

RenderReport captureFrame(const RenderOptions& options, render::FrameRenderer& renderer,
                          const gl::Capabilities& capabilities, const RenderCameras& cameras,
                          const std::function<void(std::uint32_t frame)>& progress) {
  RenderReport report;
  report.renderer = capabilities.renderer;
  report.gpuTiming = !capabilities.softwareRenderer;
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> samples;
  renderer.resetHistory();
  renderer.setTiming(report.gpuTiming ? Timing::kGpu : Timing::kWall);
  for (std::uint32_t i = 0; i < captureFrames(options); ++i) {
    if (progress) progress(i);
    renderer.render(options.frameOptions, cameras.cull, cameras.draw);
    if (i < warmUpFrames(options)) continue;
    for (const PassTime& pass : renderer.passTimes()) {
      std::vector<double>& times = samples[std::string(pass.name)];
      if (times.empty()) order.emplace_back(pass.name);
      times.push_back(pass.ms);
    }
  }
  for (const std::string& name : order) {
    // Some passes do not run in every frame.
    const double share = static_cast<double>(samples[name].size()) / options.repeat;
    report.times.passes.emplace_back(name, share * median(samples[name]));
    report.times.frameMs += report.times.passes.back().second;
  }
  report.statistics = renderer.readStatistics();
  report.maxTessellation = renderer.cullView().maxTessellation;
  return report;
}

}  // namespace jalousie::app
