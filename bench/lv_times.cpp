// Times configurations in turn, so that a change of the machine's speed affects all of them.
#include "lv_times.h"

#include <cstddef>
#include <utility>

#include "core/median.h"

namespace jalousie::bench {
namespace {

constexpr int kSettle = 2;  // frames

/// Time of kCountInterval frames, ms.
double timeOf(const Timed& timed, const scene::Camera& camera, std::string_view counted) {
  for (int k = 0; k < kSettle; ++k)
    timed.renderer.render(timed.options, camera, camera);
  double sum = 0.0;
  timed.renderer.setTiming(Timing::kWall);
  for (std::uint32_t k = 0; k < render::kCountInterval; ++k) {
    timed.renderer.render(timed.options, camera, camera);
    for (const PassTime& pass : timed.renderer.passTimes())
      sum += counted.empty() || pass.name == counted ? pass.ms : 0.0;
  }
  timed.renderer.setTiming(Timing::kOff);
  return sum;
}

}  // namespace

std::vector<double> interleavedTimes(const std::vector<Timed>& all, const scene::Camera& camera, int rounds,
                                     std::string_view pass) {
  std::vector<std::vector<double>> times(all.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t next = round % 2 == 0 ? i : all.size() - 1 - i;
      times[next].push_back(timeOf(all[next], camera, pass));
    }
  }
  std::vector<double> medians;
  medians.reserve(times.size());
  for (std::vector<double>& samples : times)
    medians.push_back(median(std::move(samples)));
  return medians;
}

}  // namespace jalousie::bench
