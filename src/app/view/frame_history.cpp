// The history as a queue of samples, and its JSON.
#include "app/view/frame_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/render_report.h"
#include "compare/statistics_table.h"

namespace jalousie::app {

void FrameHistory::add(FrameSample sample) {
  samples_.push_back(std::move(sample));
  while (samples_.size() > kMostFrames || samples_.back().seconds - samples_.front().seconds > kSeconds)
    samples_.pop_front();
}

std::string FrameHistory::json(const std::string& renderer, bool gpuTiming, const asset::ContentCounts& ignored) const {
  nlohmann::ordered_json root;
  root["renderer"] = renderer;
  root["timing"] = gpuTiming ? "gpu" : "wall";
  root["ignored"] = nlohmann::ordered_json(ignored);
  root["frames"] = nlohmann::ordered_json::array();
  for (const FrameSample& sample : samples_) {
    nlohmann::ordered_json frame;
    frame["seconds"] = sample.seconds;
    addCounts(frame, sample.statistics);
    frame["passes"] = nlohmann::ordered_json::object();
    for (const auto& [name, ms] : sample.passes)
      frame["passes"][name] = ms;
    frame["frame_ms"] = sample.frameMs;
    root["frames"].push_back(std::move(frame));
  }
  return root.dump(2) + "\n";
}

std::vector<std::string> FrameHistory::passNames() const {
  std::vector<std::string> names;
  for (const FrameSample& sample : samples_) {
    auto at = names.begin();
    for (const auto& [name, ms] : sample.passes) {
      const auto known = std::find(names.begin(), names.end(), name);
      at = (known != names.end() ? known : names.insert(at, name)) + 1;
    }
  }
  return names;
}

std::optional<double> passMs(const FrameSample& sample, const std::string& name) {
  std::optional<double> sum;
  for (const auto& [pass, ms] : sample.passes)
    if (pass == name) sum = sum.value_or(0.0) + ms;
  return sum;
}

std::string FrameHistory::csv() const {
  const std::vector<std::string> passes = passNames();
  std::string text = "seconds,frame_ms";
  for (const compare::StatisticsField& field : compare::kStatisticsFields)
    text += fmt::format(",{}", field.key);
  for (const std::string& name : passes)
    text += fmt::format(",{} ms", name);
  text += "\n";
  for (const FrameSample& sample : samples_) {
    text += fmt::format("{:.6f},{}", sample.seconds, sample.frameMs);
    for (const compare::StatisticsField& field : compare::kStatisticsFields)
      text += fmt::format(",{}", sample.statistics.*field.value);
    for (const std::string& name : passes) {
      const std::optional<double> ms = passMs(sample, name);
      text += ms ? fmt::format(",{}", *ms) : std::string(",");
    }
    text += "\n";
  }
  return text;
}

FrameSample makeSample(double seconds, const std::vector<PassTime>& passes, const render::FrameStatistics& statistics) {
  FrameSample sample;
  sample.seconds = seconds;
  sample.statistics = statistics;
  for (const PassTime& pass : passes) {
    sample.passes.emplace_back(pass.name, pass.ms);
    sample.frameMs += pass.ms;
  }
  return sample;
}

}  // namespace jalousie::app
