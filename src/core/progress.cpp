// Draws the progress line with a carriage return, as terminals expect.
#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "core/error.h"
#include "core/standard_streams.h"

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
  std::fputs(fmt::format("\r\033[K{}{}  {}", label_, percent, oneLine(detail)).c_str(), stderr);
  std::fflush(stderr);
}

void Progress::print(const std::string& line) {
  if (visible_) std::fputs("\r\033[K", stderr);
  printError(line);
  nextDraw_ = {};
}

}  // namespace jalousie
