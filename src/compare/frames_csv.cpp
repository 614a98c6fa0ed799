// Columns of counts, errors, passes and levels.
#include "compare/frames_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "compare/configuration.h"
#include "compare/statistics_table.h"

namespace jalousie::compare {
namespace {

/// Counts that have a column, in this order.
constexpr std::string_view kCounts[] = {
    "triangles",        "draws",        "drawn",     "drawn_early", "drawn_stale", "culled_frustum",
    "culled_occlusion", "culled_small", "occluders", "switches",    "fading",      "dropped"};

std::uint64_t countOf(const render::FrameStatistics& statistics, std::string_view key) {
  return statistics.*statisticsField(key).value;
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

/// Columns that depend on what was measured.
struct Columns {
  std::vector<std::string> passes;  ///< in the order of their first occurrence
  std::size_t levels = 0;
};

Columns columnsOf(const Results& results) {
  Columns columns;
  for (const Sample& sample : results.samples) {
    columns.levels = std::max(columns.levels, sample.statistics.lodHistogram.size());
    for (const auto& [name, ms] : sample.passes)
      if (std::find(columns.passes.begin(), columns.passes.end(), name) == columns.passes.end())
        columns.passes.push_back(name);
  }
  return columns;
}

std::string headLine(const Columns& columns) {
  std::string text = "frame,configuration";
  for (const std::string_view key : kCounts)
    text += fmt::format(",{}", key);
  for (const CountGroup& group : kCountGroups)
    for (const std::string_view key : group.keys)
      text += fmt::format(",{}", key);
  text += ",visible,visible_switched,lost,wrong_pixels,flip,flip_covered,psnr,ssim,butteraugli,temporal_flip,frame_ms";
  for (const std::string& pass : columns.passes)
    text += "," + csvField(pass + " ms");
  for (std::size_t k = 0; k < columns.levels; ++k)
    text += fmt::format(",level_{}", k);
  return text + "\n";
}

/// Time of a pass in one frame, which may run it more than once; empty if it did not run.
std::string passField(const Sample& sample, const std::string& pass) {
  double sum = 0.0;
  bool ran = false;
  for (const auto& [name, ms] : sample.passes) {
    if (name != pass) continue;
    sum += ms;
    ran = true;
  }
  return ran ? fmt::format(",{:.3f}", sum) : ",";
}

std::string line(const Sample& sample, const std::string& name, const Columns& columns) {
  std::string text = fmt::format("{},{}", sample.frame, csvField(name));
  for (const std::string_view key : kCounts)
    text += fmt::format(",{}", countOf(sample.statistics, key));
  for (const CountGroup& group : kCountGroups)
    for (const std::string_view key : group.keys)
      text += fmt::format(",{}", countOf(sample.statistics, key));
  text += sample.visible ? fmt::format(",{}", *sample.visible) : ",";
  text += sample.switched ? fmt::format(",{}", *sample.switched) : ",";
  text += sample.lost ? fmt::format(",{}", *sample.lost) : ",";
  text += sample.wrongPixels ? fmt::format(",{}", *sample.wrongPixels) : ",";
  text += sample.error ? fmt::format(",{:.6f}", sample.error->flip) : ",";
  const bool covered = sample.error && sample.error->flipCovered;
  text += covered ? fmt::format(",{:.6f}", *sample.error->flipCovered) : ",";
  text += sample.error ? fmt::format(",{:.4f},{:.6f}", sample.error->psnr, sample.error->ssim) : ",,";
  const bool judged = sample.error && sample.error->butteraugli;
  text += judged ? fmt::format(",{:.6f}", *sample.error->butteraugli) : ",";
  text += sample.temporal ? fmt::format(",{:.6f}", *sample.temporal) : ",";
  text += fmt::format(",{:.3f}", sample.frameMs);
  for (const std::string& pass : columns.passes)
    text += passField(sample, pass);
  const std::vector<std::uint64_t>& levels = sample.statistics.lodHistogram;
  for (std::size_t k = 0; k < columns.levels; ++k)
    text += fmt::format(",{}", k < levels.size() ? levels[k] : 0);
  return text + "\n";
}

}  // namespace

std::string framesCsv(const Results& results, const std::vector<Configuration>& configurations) {
  const Columns columns = columnsOf(results);
  std::string text = headLine(columns);
  for (const Sample& sample : results.samples)
    text += line(sample, configurations[sample.configuration].name, columns);
  return text;
}

}  // namespace jalousie::compare
