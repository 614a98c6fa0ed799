// Lines for a log in which a long bake shows that it goes on.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace jalousie::bake {

/// Decides when a line is due: not before kInterval has passed, and then once for each. The caller reads the clock.
class ProgressLog {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kInterval{10};

  explicit ProgressLog(Time start) : start_(start), next_(start + kInterval) {}

  /// @param step  what is done now, on one line; may be empty   @return  the line to print, nullopt if none is due
  std::optional<std::string> lineAt(Time now, const std::string& step);

 private:
  Time start_;
  Time next_;
};

/// "42 s", "3 min 20 s", "2 h 5 min".
std::string durationText(double seconds);

}  // namespace jalousie::bake
