// Figures of the last seconds: for the graph, and as JSON.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "gl/pass_timer.h"
#include "render/frame_statistics.h"

namespace jalousie::app {

struct FrameSample {
  double seconds = 0.0;                                ///< when, since the program started
  double frameMs = 0.0;                                ///< sum of the passes
  std::vector<std::pair<std::string, double>> passes;  ///< name and milliseconds, in frame order
  render::FrameStatistics statistics;                  ///< the newest that had arrived: up to two frames older
};

/// The frames of one configuration, newest last.
class FrameHistory {
 public:
  static constexpr double kSeconds = 10.0;
  static constexpr std::size_t kMostFrames = 1200;

  void add(FrameSample sample);
  void clear() { samples_.clear(); }
  const std::deque<FrameSample>& samples() const { return samples_; }

  /// {"renderer", "timing", "frames": [{"seconds", "frame_ms", "passes", and the counts of `jalousie render --json`}]}
  std::string json(const std::string& renderer, bool gpuTiming) const;

 private:
  std::deque<FrameSample> samples_;
};

/// A frame's sample. @param passes  of the timer
FrameSample makeSample(double seconds, const std::vector<PassTime>& passes,
                       const render::FrameStatistics& statistics);

}  // namespace jalousie::app
