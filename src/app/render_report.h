// Statistics and times of a rendered frame, as JSON with fixed keys and as text for a terminal.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/render_options.h"
#include "asset/scene_types.h"
#include "render/frame_statistics.h"

namespace jalousie::app {

/// Names and milliseconds of the passes, in frame order.
struct FrameTimes {
  /// Median over the repeats, times the share of frames in which the pass ran.
  std::vector<std::pair<std::string, double>> passes;
  double frameMs = 0.0;  ///< sum over the passes
};

struct RenderReport {
  std::string renderer;
  bool gpuTiming = false;  ///< GPU timestamps; false: wall time between two glFinish
  render::FrameStatistics statistics;
  FrameTimes times;
  std::optional<std::uint64_t> visible;  ///< objects with a pixel; absent where nothing was drawn, or from elsewhere
  std::optional<std::uint64_t> wrongPixels;  ///< pixels that culling changed
  std::optional<double> seconds;             ///< time of the animations, where they play
  std::uint32_t points = 0;                  ///< of the scene: all are drawn in every frame
  std::uint32_t segments = 0;                ///< the same for line segments
  asset::ContentCounts ignored;              ///< what the scene's file holds that is not drawn
  std::uint32_t maxTessellation = 0;  ///< finest level in use; drivers can force a lower one than the option asks for
};

/// Adds the counts of a frame and its level histogram (docs/formats.md).
void addCounts(nlohmann::ordered_json& json, const render::FrameStatistics& statistics);
/// Keys as in docs/formats.md. @param options  after finish()
std::string reportJson(const RenderOptions& options, const RenderReport& report);
/// A summary of the same figures in a few lines.
std::string reportText(const RenderOptions& options, const RenderReport& report);

}  // namespace jalousie::app
