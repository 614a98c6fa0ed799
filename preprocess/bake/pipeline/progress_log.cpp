// Formats lines and times.
#include "bake/pipeline/progress_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace jalousie::bake {

std::optional<std::string> ProgressLog::lineAt(Time now, const std::string& step) {
  if (now < next_) return std::nullopt;
  while (next_ <= now)
    next_ += kInterval;
  return fmt::format("baking for {}{}{}", durationText(std::chrono::duration<double>(now - start_).count()),
                     step.empty() ? "" : ": ", step);
}

std::string durationText(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::lround(std::min(seconds, 1e6)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace jalousie::bake
