// The history as a queue of samples, and its JSON.
#include "app/view/frame_history.h"

#include <nlohmann/json.hpp>

#include "app/render_report.h"

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
