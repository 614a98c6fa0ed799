// Statistics and times of the frames of the last 10 s, for the frame graph and as JSON.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene_types.h"
#include "gl/pass_timer.h"
#include "render/frame_statistics.h"

namespace jalousie::app {

struct FrameSample {
  double seconds = 0.0;                                ///< time of the frame, as secondsNow()
  double frameMs = 0.0;                                ///< sum of the passes
  std::vector<std::pair<std::string, double>> passes;  ///< name and milliseconds, in frame order
  render::FrameStatistics statistics;  ///< newest statistics read back: of this frame or up to two frames older
};

/// The frames of one configuration, newest last. Frames older than kSeconds or beyond kMostFrames are removed.
class FrameHistory {
 public:
  static constexpr double kSeconds = 10.0;
  static constexpr std::size_t kMostFrames = 1200;

  void add(FrameSample sample);
  void clear() { samples_.clear(); }
  const std::deque<FrameSample>& samples() const { return samples_; }

  /// Names of all passes, in frame order; a pass that only some frames have follows its predecessor.
  std::vector<std::string> passNames() const;
  /// One line per frame, oldest first: seconds, frame_ms, the counts of `jalousie render --json`, and a column per
  /// pass, ms, empty where the frame does not have it.
  std::string csv() const;
  /// {"renderer", "timing", "ignored", "frames": [{"seconds", "frame_ms", "passes", and the counts of
  /// `jalousie render --json`}]}
  /// @param ignored  what the document holds that is not drawn
  std::string json(const std::string& renderer, bool gpuTiming, const asset::ContentCounts& ignored) const;

 private:
  std::deque<FrameSample> samples_;
};

/// Milliseconds of a pass; absent where the frame does not have it. Passes of one name add up.
std::optional<double> passMs(const FrameSample& sample, const std::string& name);

/// Sample of a frame. @param passes  times of the passes, in frame order
FrameSample makeSample(double seconds, const std::vector<PassTime>& passes, const render::FrameStatistics& statistics);

}  // namespace jalousie::app
