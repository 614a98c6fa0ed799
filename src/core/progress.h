// Shows the progress of long work as a redrawn line on a terminal; nothing in a log or with quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace jalousie {

/// Shows "label  42 %" on stderr until it is destroyed, which erases the line. Not thread-safe.
class Progress {
 public:
  /// @param total  number of steps; 0 shows only the label
  Progress(std::string label, std::uint64_t total, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the number of finished steps and an optional detail; redraws at most ten times a second.
  void update(std::uint64_t done, const std::string& detail = {});
  /// Writes a line to stderr, terminal or not; the progress is redrawn below it.
  void print(const std::string& line);
  /// Whether stderr is a terminal and quiet is off.
  bool visible() const { return visible_; }

 private:
  std::string label_;
  std::uint64_t total_;
  bool visible_;
  std::chrono::steady_clock::time_point nextDraw_{};
};

}  // namespace jalousie
