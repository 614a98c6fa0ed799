// Sweeps over tau and their interpolation.
#include "lv_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/image_error.h"
#include "core/median.h"
#include "gl_bench.h"

namespace jalousie::bench {
namespace {

constexpr int kRounds = 7;

double frameMs(render::FrameRenderer& renderer, std::string_view pass) {
  double sum = 0.0;
  for (const PassTime& time : renderer.passTimes())
    sum += pass.empty() || time.name == pass ? time.ms : 0.0;
  return sum;
}

}  // namespace

Sample Stage::sample(const render::FrameOptions& options) {
  const ImageRgba8 image = settledImage(renderer, options, camera);
  const render::FrameStatistics statistics = renderer.readStatistics();
  requireCounts(statistics, "a sample");
  return {static_cast<double>(statistics.triangles), compare::psnr(reference, image), compare::ssim(reference, image)};
}

std::vector<Sample> Stage::sweep(render::FrameOptions options, std::span<const float> taus, const char* name) {
  std::vector<Sample> samples;
  for (const float tau : taus) {
    options.tau = tau;
    samples.push_back(sample(options));
    if (samples.size() > kOnePixel + 1 && samples.back().triangles > kMostTriangles) break;
  }
  require(samples.back().psnr >= samples.front().psnr, fmt::format("{}: the error grows where tau falls", name));
  return samples;
}

std::vector<double> Stage::interleavedTimes(const std::vector<render::FrameOptions>& all, std::string_view pass) {
  std::vector<std::vector<double>> times(all.size());
  renderer.setTiming(Timing::kWall);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      renderer.render(all[i], camera, camera);
      renderer.render(all[i], camera, camera);
      double sum = 0.0;
      for (std::uint32_t k = 0; k < render::kCountInterval; ++k) {
        renderer.render(all[i], camera, camera);
        sum += frameMs(renderer, pass);
      }
      times[i].push_back(sum);
    }
  }
  renderer.setTiming(Timing::kOff);
  std::vector<double> medians;
  medians.reserve(times.size());
  for (std::vector<double>& samples : times)
    medians.push_back(median(std::move(samples)));
  return medians;
}

double trianglesAt(const std::vector<Sample>& samples, double Sample::*error, double value) {
  if (value <= samples.front().*error) return samples.front().triangles;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    if (value > b.*error || std::isinf(b.*error)) continue;
    const double t = (value - a.*error) / std::max(b.*error - a.*error, 1e-9);
    return std::exp(std::log(a.triangles) + t * (std::log(b.triangles) - std::log(a.triangles)));
  }
  return std::nan("");
}

double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels, double Sample::*error) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = kOnePixel - 1; i <= kOnePixel + 2 && i < levels.size(); ++i) {
    const double value = levels[i].*error;
    const double ratio = std::log(trianglesAt(samples, error, value) / trianglesAt(base, error, value));
    if (std::isnan(ratio)) continue;
    sum += ratio;
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : std::nan("");
}

}  // namespace jalousie::bench
