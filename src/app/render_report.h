// The figures of a rendered frame, as JSON with fixed keys and as text for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/render_options.h"
#include "render/frame_statistics.h"

namespace jalousie::app {

/// Names and milliseconds of the passes, in frame order.
struct FrameTimes {
  std::vector<std::pair<std::string, double>> passes;  ///< median over the repeats, times the share of frames it ran in
  double frameMs = 0.0;                                ///< their sum
};

struct RenderReport {
  std::string renderer;
  bool gpuTiming = false;  ///< times are differences of GPU timestamps, not wall time between two glFinish
  render::FrameStatistics statistics;
  FrameTimes times;
  std::uint32_t maxTessellation = 0;  ///< finest level in use; below the option where the driver needs it
};

/// Adds the counts of a frame under their keys.
void addCounts(nlohmann::ordered_json& json, const render::FrameStatistics& statistics);
/// Keys as in docs/formats.md. @param options  finished
std::string reportJson(const RenderOptions& options, const RenderReport& report);
/// A short summary with the same figures.
std::string reportText(const RenderOptions& options, const RenderReport& report);

}  // namespace jalousie::app
