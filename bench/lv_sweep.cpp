// Sweeps over tau.
#include "lv_sweep.h"

#include <fmt/format.h>

#include <utility>

#include "gl_bench.h"

namespace jalousie::bench {

Sample Reference::errorsOf(const ImageRgba8& test) const {
  Sample sample{0.0, compare::psnr(image, test), compare::ssim(image, test)};
  if (!flip) return sample;
  const std::vector<float> map = compare::flipMap(*flip, compare::FlipImage(test));
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (covered[i] == 0) continue;
    sum += map[i];
    ++count;
  }
  if (count > 0) sample.flip = sum / static_cast<double>(count);
  return sample;
}

Reference coveredReference(render::FrameRenderer& renderer, const scene::Camera& camera) {
  Reference reference{settledImage(renderer, finestOptions(/*twoPhases=*/false), camera)};
  reference.flip.emplace(reference.image);
  renderer.renderIds();
  const std::vector<std::uint32_t> ids = renderer.readIds();  // row 0 at the bottom
  const std::uint32_t width = reference.image.width;
  const std::uint32_t height = reference.image.height;
  reference.covered.resize(ids.size());
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      reference.covered[std::size_t{y} * width + x] = ids[std::size_t{height - 1 - y} * width + x] != 0 ? 1 : 0;
  return reference;
}

Sample Stage::sample(const render::FrameOptions& options) {
  ImageRgba8 image = settledImage(renderer, options, camera);
  const render::FrameStatistics statistics = renderer.readStatistics();
  requireCounts(statistics, "a sample");
  Sample sample = reference.errorsOf(image);
  sample.triangles = static_cast<double>(statistics.triangles);
  if (pictures != nullptr) pictures->push_back(std::move(image));
  return sample;
}

std::vector<Sample> Stage::sweep(render::FrameOptions options, std::span<const float> taus, const char* name) {
  std::vector<Sample> samples;
  for (const float tau : taus) {
    options.tau = tau;
    samples.push_back(sample(options));
    if (samples.size() > kOnePixel + 1 && samples.back().triangles > kMostTriangles) break;
  }
  requireImproves(samples, name);
  return samples;
}

void requireImproves(const std::vector<Sample>& samples, const char* name) {
  require(samples.back().psnr >= samples.front().psnr, fmt::format("{}: the error grows where tau falls", name));
}

}  // namespace jalousie::bench
