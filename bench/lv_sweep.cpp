// Sweeps over tau.
#include "lv_sweep.h"

#include <fmt/format.h>

#include <utility>

#include "compare/frame_objects.h"
#include "gl_bench.h"

namespace jalousie::bench {

Sample Reference::errorsOf(const ImageRgba8& test) const {
  Sample sample{0.0, compare::psnr(image, test), compare::ssim(image, test)};
  if (!flip) return sample;
  const std::vector<float> map = compare::flipMap(*flip, compare::FlipImage(test));
  sample.flip = compare::meanOver(map, covered).value_or(sample.flip);
  return sample;
}

Reference coveredReference(render::FrameRenderer& renderer, const scene::Camera& camera) {
  Reference reference{settledImage(renderer, finestOptions(/*twoPhases=*/false), camera)};
  reference.flip.emplace(reference.image);
  renderer.renderIds();
  reference.covered = compare::coveredPixels(renderer.readIds(), reference.image.width);
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
