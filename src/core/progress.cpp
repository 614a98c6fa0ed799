// Draws the progress line with a carriage return, as terminals expect.
#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace jalousie {

Progress::Progress(std::string label, std::uint64_t total, bool quiet)
    : label_(std::move(label)), total_(total), visible_(!quiet && ::isatty(STDERR_FILENO) == 1) {
  update(0);
}

Progress::~Progress() {
  if (!visible_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

void Progress::update(std::uint64_t done, const std::string& detail) {
  const auto now = std::chrono::steady_clock::now();
  if (!visible_ || now < nextDraw_) return;
  nextDraw_ = now + std::chrono::milliseconds(100);
  const std::string percent = total_ > 0 ? fmt::format("  {:3d} %", 100 * done / total_) : std::string();
  fmt::print(stderr, "\r\033[K{}{}  {}", label_, percent, detail);
  std::fflush(stderr);
}

void Progress::print(const std::string& line) {
  fmt::print(stderr, "{}{}\n", visible_ ? "\r\033[K" : "", line);
  std::fflush(stderr);
  nextDraw_ = {};
}

}  // namespace jalousie
