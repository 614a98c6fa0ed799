// Interpolation between the samples of a sweep.
#include "equal_error.h"

#include <algorithm>

#include "core/check.h"

namespace jalousie::bench {

Sample meanOf(const std::vector<Sample>& samples) {
  JAL_CHECK(!samples.empty());
  const double share = 1.0 / static_cast<double>(samples.size());
  Sample mean{0.0, 0.0, 0.0, 0.0};
  double squaredError = 0.0;  // of colours from 0 to 1
  for (const Sample& sample : samples) {
    mean.triangles += share * sample.triangles;
    mean.ssim += share * sample.ssim;
    mean.flip += share * sample.flip;
    squaredError += share * std::pow(10.0, -sample.psnr / 10.0);
  }
  mean.psnr = -10.0 * std::log10(squaredError);
  return mean;
}

double trianglesAt(const std::vector<Sample>& samples, const ErrorMeasure& measure, double value) {
  const double wanted = measure.quality(value);
  if (wanted <= measure.quality(samples.front())) return samples.front().triangles;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    const double low = measure.quality(a);
    const double high = measure.quality(b);
    if (!(wanted <= high) || std::isinf(high)) continue;
    const double t = (wanted - low) / std::max(high - low, 1e-9);
    return std::exp(std::log(a.triangles) + t * (std::log(b.triangles) - std::log(a.triangles)));
  }
  return std::nan("");
}

std::vector<double> ratiosAtEqualErrors(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                                        const std::vector<Sample>& levels, const ErrorMeasure& measure) {
  std::vector<double> ratios;
  for (std::size_t i = kOnePixel - 1; i <= kOnePixel + 2 && i < levels.size(); ++i) {
    const double value = levels[i].*measure.value;
    ratios.push_back(trianglesAt(samples, measure, value) / trianglesAt(base, measure, value));
  }
  return ratios;
}

double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels, const ErrorMeasure& measure) {
  return geometricMean(ratiosAtEqualErrors(samples, base, levels, measure));
}

double geometricMean(const std::vector<double>& values) {
  double sum = 0.0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += std::log(value);
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : std::nan("");
}

}  // namespace jalousie::bench
