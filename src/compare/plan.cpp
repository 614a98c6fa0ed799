// Frames of a range, and which of them are kept.
#include "compare/plan.h"

#include <algorithm>

#include "core/check.h"

namespace jalousie::compare {

std::vector<std::uint32_t> FrameRange::frames() const {
  JAL_CHECK(step > 0U);
  std::vector<std::uint32_t> result;
  for (std::uint64_t frame = first; frame <= last; frame += step)
    result.push_back(static_cast<std::uint32_t>(frame));
  return result;
}

std::vector<std::uint32_t> Plan::keptFrames() const {
  const std::vector<std::uint32_t> frames = range.frames();
  std::vector<std::uint32_t> result;
  if (reference == Reference::kNone || frames.empty()) return result;
  const std::size_t count = std::min<std::size_t>(keep, frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = count == 1 ? frames.size() / 2 : i * (frames.size() - 1) / (count - 1);
    result.push_back(frames[index]);
  }
  return result;
}

}  // namespace jalousie::compare
