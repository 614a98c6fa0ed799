// Formats the statistics and times of one frame.
#include "app/render_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/statistics_table.h"

namespace jalousie::app {
namespace {

/// 1234567 -> "1,234,567".
std::string grouped(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

// The figures that a report shows depend on the method.
bool followsTau(const RenderOptions& options) {
  return rowOf(options.frameOptions.lodRule).followsError;
}
bool tessellates(const RenderOptions& options) {
  return rowOf(options.frameOptions.detail).patches;
}
bool hasTwoPhases(const RenderOptions& options) {
  return rowOf(options.frameOptions.cullMode).twoPhases;
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

void addCounts(nlohmann::ordered_json& json, const render::FrameStatistics& statistics) {
  for (const compare::StatisticsField& field : compare::kStatisticsFields)
    json[field.key] = statistics.*field.value;
  json["lod_histogram"] = statistics.lodHistogram;
}

std::string reportJson(const RenderOptions& options, const RenderReport& report) {
  const render::FrameStatistics& s = report.statistics;
  nlohmann::ordered_json json;
  json["renderer"] = report.renderer;
  json["width"] = options.width;
  json["height"] = options.height;
  json["mode"] = rowOf(options.frameOptions.cullMode).name;
  json["lod"] = rowOf(options.frameOptions.lodRule).name;
  json["lv"] = rowOf(options.frameOptions.lvMeasure).name;
  if (followsTau(options)) json["tau"] = options.frameOptions.tau;
  const LodRuleRow& rule = rowOf(options.frameOptions.lodRule);
  if (relaxesTau(rule)) json["relax"] = options.frameOptions.relax;
  if (rule.pricesTriangles) {
    json["max_error"] = options.frameOptions.maxError;
    json["triangle_budget"] = options.frameOptions.triangleBudget;
  }
  if (masksErrors(options.frameOptions)) json["masking"] = true;
  json["detail"] = rowOf(options.frameOptions.detail).name;
  if (tessellates(options)) json["max_tessellation"] = report.maxTessellation;
  addCounts(json, s);
  if (report.seconds) json["seconds"] = *report.seconds;
  if (report.visible) json["visible"] = *report.visible;
  if (report.wrongPixels) json["wrong_pixels"] = *report.wrongPixels;
  json["points"] = report.points;
  json["segments"] = report.segments;
  json["ignored"] = nlohmann::ordered_json(report.ignored);
  json["timing"] = report.gpuTiming ? "gpu" : "wall";
  json["passes"] = nlohmann::ordered_json::object();
  for (const auto& [name, ms] : report.times.passes)
    json["passes"][name] = ms;
  json["frame_ms"] = report.times.frameMs;
  return json.dump(2) + "\n";
}

std::string reportText(const RenderOptions& options, const RenderReport& report) {
  const render::FrameStatistics& s = report.statistics;
  std::string text = fmt::format("{}x{}  mode {}  lod {}  detail {}   {}\n", options.width, options.height,
                                 rowOf(options.frameOptions.cullMode).name, rowOf(options.frameOptions.lodRule).name,
                                 rowOf(options.frameOptions.detail).name, report.renderer);
  text += fmt::format("  objects   {:>13}   outside {}, occluded {}, ", grouped(s.objects), grouped(s.culledFrustum),
                      grouped(s.culledOcclusion));
  if (s.culledSmall > 0) text += fmt::format("small {}, ", grouped(s.culledSmall));
  text += fmt::format("drawn {}", grouped(s.drawn));
  if (report.visible) text += fmt::format(", visible {}", grouped(*report.visible));
  if (hasTwoPhases(options)) text += fmt::format(" ({} in phase 1)", grouped(s.drawnEarly));
  if (s.occluders > 0) text += fmt::format(" ({} occluders)", grouped(s.occluders));
  text += '\n';
  if (report.wrongPixels.value_or(0) > 0)
    text += fmt::format("  wrong pixels {:>10}   culling left out what they show\n", grouped(*report.wrongPixels));
  if (s.cells > 0) text += fmt::format("  cells     {:>13}   drawn {}\n", grouped(s.cells), grouped(s.cellsDrawn));
  if (s.queries > 0)
    text += fmt::format("  queries   {:>13}   waits {}, round trips {}, state changes {}, draw calls {}\n",
                        grouped(s.queries), grouped(s.queryWaits), grouped(s.queryRoundTrips), grouped(s.querySwitches),
                        grouped(s.sliceDraws));
  if (s.shadows > 0)
    text += fmt::format("  shadows   {:>13}   nodes {}, plane tests {}, decided in {:.2f} ms\n", s.shadows,
                        grouped(s.nodesVisited), grouped(s.planeTests), 1e-6 * static_cast<double>(s.decisionNs));
  if (s.rooms > 0)
    text += fmt::format("  rooms     {:>13}   portals {}, objects tested {}, decided in {:.2f} ms\n", grouped(s.rooms),
                        grouped(s.portals), grouped(s.nodesVisited), 1e-6 * static_cast<double>(s.decisionNs));
  text += fmt::format("  triangles {:>13}   {:.1f} % of {}\n", grouped(s.triangles),
                      percent(s.triangles, s.trianglesFinest), grouped(s.trianglesFinest));
  if (s.facesTested + s.facesWhole > 0)
    text += fmt::format("  back faces{:>13}   {:.1f} % of {} single-sided, {} left whole, commands {}\n",
                        grouped(s.facesCulled), percent(s.facesCulled, s.facesTested), grouped(s.facesTested),
                        grouped(s.facesWhole), grouped(s.draws));
  if (report.points + report.segments > 0)
    text += fmt::format("  points    {:>13}   line segments {}\n", grouped(report.points), grouped(report.segments));
  text += tessellates(options) ? "  levels 1.." : "  LOD 0..";
  text += fmt::format(" {}\n", fmt::join(s.lodHistogram, " "));
  text += fmt::format("  time {:.1f} ms:", report.times.frameMs);
  for (const auto& [name, ms] : report.times.passes)
    text += fmt::format("  {} {:.1f}", name, ms);
  return text + "\n";
}

}  // namespace jalousie::app
