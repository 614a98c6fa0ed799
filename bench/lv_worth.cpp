// Cost at equal image error: sweeps over tau against both baselines.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/image_error.h"
#include "core/median.h"
#include "gl_bench.h"
#include "lv_setup.h"

namespace jalousie::bench {
namespace {

constexpr std::array kTaus = {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F};  // pixels
constexpr std::size_t kOnePixel = 3;                                         // index of tau = 1
constexpr double kMostTriangles = 2e7;  // from here on, a frame takes minutes on a software renderer
constexpr int kRounds = 7;

struct Sample {
  double triangles = 0.0;
  double psnr = 0.0;  ///< dB
  double ssim = 0.0;
};

/// A renderer, a camera and the picture with every object at its finest level.
struct Stage {
  render::FrameRenderer& renderer;
  scene::Camera camera;
  ImageRgba8 reference;

  Sample sample(const render::FrameOptions& options) {
    const ImageRgba8 image = settledImage(renderer, options, camera);
    const render::FrameStatistics statistics = renderer.readStatistics();
    requireCounts(statistics, "a sample");
    return {static_cast<double>(statistics.triangles), compare::psnr(reference, image),
            compare::ssim(reference, image)};
  }

  /// Samples of a configuration over kTaus, finest last; the finest ones are left out where they cost too much.
  std::vector<Sample> sweep(const LvConfiguration& configuration) {
    std::vector<Sample> samples;
    for (const float tau : kTaus) {
      samples.push_back(sample(optionsOf(configuration, tau)));
      if (samples.size() > kOnePixel + 1 && samples.back().triangles > kMostTriangles) break;
    }
    require(samples.back().psnr >= samples.front().psnr,
            fmt::format("{}: the error grows where tau falls", configuration.name));
    return samples;
  }
};

/// Triangles at which a sweep reaches an error: the logarithm of the triangles is interpolated linearly between
/// samples. Below its range the cheapest sample counts; above it the result is NaN.
double trianglesAt(const std::vector<Sample>& samples, double psnr) {
  if (psnr <= samples.front().psnr) return samples.front().triangles;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    if (psnr > b.psnr || std::isinf(b.psnr)) continue;
    const double t = (psnr - a.psnr) / std::max(b.psnr - a.psnr, 1e-9);
    return std::exp(std::log(a.triangles) + t * (std::log(b.triangles) - std::log(a.triangles)));
  }
  return std::nan("");
}

/// Mean ratio of triangles at equal error, over the errors that `levels` has at a tau of 2, 1, 0.5 and 0.25.
double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = kOnePixel - 1; i <= kOnePixel + 2 && i < levels.size(); ++i) {
    const double ratio = std::log(trianglesAt(samples, levels[i].psnr) / trianglesAt(base, levels[i].psnr));
    if (std::isnan(ratio)) continue;
    sum += ratio;
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : std::nan("");
}

double frameMs(render::FrameRenderer& renderer) {
  double sum = 0.0;
  for (const PassTime& pass : renderer.passTimes())
    sum += pass.ms;
  return sum;
}

/// Median times of kCountInterval frames, one of which counts pixels. The configurations run in turn, each after two
/// frames in which it settles.
std::vector<double> interleavedTimes(Stage& stage, const std::vector<render::FrameOptions>& all) {
  std::vector<std::vector<double>> times(all.size());
  render::FrameRenderer& renderer = stage.renderer;
  renderer.setTiming(Timing::kWall);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      renderer.render(all[i], stage.camera, stage.camera);
      renderer.render(all[i], stage.camera, stage.camera);
      double sum = 0.0;
      for (std::uint32_t k = 0; k < render::kCountInterval; ++k) {
        renderer.render(all[i], stage.camera, stage.camera);
        sum += frameMs(renderer);
      }
      times[i].push_back(sum);
    }
  }
  renderer.setTiming(Timing::kOff);
  std::vector<double> medians;
  for (std::vector<double>& samples : times)
    medians.push_back(median(std::move(samples)));
  return medians;
}

/// One line of the table. Ratios that were not measured are NaN.
struct Row {
  std::string name;
  Sample sample;
  double time;       ///< over that of kUniform at tau = 1
  double toUniform;  ///< triangles at equal PSNR over those of kUniform
  double toFrustum;  ///< likewise of kFrustum
};

void add(const LvView& view, const Row& row, nlohmann::ordered_json& figures) {
  const auto orNull = [](double value) {
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
  };
  fmt::print("| {} | {:.0f} | {:.2f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} |\n", row.name, row.sample.triangles,
             row.sample.psnr, row.sample.ssim, row.time, row.toUniform, row.toFrustum);
  std::fflush(stdout);
  figures.push_back(
      {{"scene", view.sceneName},
       {"view", view.text},
       {"configuration", row.name},
       {"triangles", row.sample.triangles},
       {"psnr", std::isinf(row.sample.psnr) ? nlohmann::ordered_json() : nlohmann::ordered_json(row.sample.psnr)},
       {"ssim", row.sample.ssim},
       {"frame_ratio", orNull(row.time)},
       {"triangles_at_equal_psnr_over_hiz", orNull(row.toUniform)},
       {"triangles_at_equal_psnr_over_frustum", orNull(row.toFrustum)}});
}

std::size_t nearestPsnr(const std::vector<Sample>& samples, double psnr) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (std::abs(samples[i].psnr - psnr) < std::abs(samples[nearest].psnr - psnr)) nearest = i;
  return nearest;
}

/// Two-phase culling must not change the reference.
void requireReference(Stage& stage) {
  const scene::Camera& camera = stage.camera;
  stage.renderer.resetHistory();
  stage.renderer.render(finestOptions(/*twoPhases=*/true), camera, camera);
  require(std::isinf(compare::psnr(stage.reference, stage.renderer.readImage())),
          "two-phase culling changes the picture at the finest level");
}

void printHead(const LvView& view) {
  fmt::print(
      "{}, view {}\n"
      "| configuration | triangles | PSNR | SSIM | frame / hiz + pixel-error "
      "| triangles at equal PSNR / hiz + pixel-error | / frustum + pixel-error |\n|---|---|---|---|---|---|---|\n",
      view.sceneName, view.text);
}

}  // namespace

void measureWorth(const LvView& view, bool allMeasures, nlohmann::ordered_json& figures) {
  render::FrameRenderer renderer(view.scene, kLvWidth, kLvHeight);
  Stage stage{renderer, view.camera(), {}};
  stage.reference = settledImage(renderer, finestOptions(/*twoPhases=*/false), stage.camera);
  requireReference(stage);
  const std::vector<Sample> uniform = stage.sweep(kUniform);
  const std::vector<Sample> frustum = stage.sweep(kFrustum);
  const std::vector<Sample> own = stage.sweep(kDefault);
  const Sample thesis = stage.sample(optionsOf(kThesis, 1.0F));
  printHead(view);

  // Times at about equal error: the tau at which the default's PSNR is nearest to the baseline's at one pixel.
  const std::size_t nearest = nearestPsnr(own, uniform[kOnePixel].psnr);
  std::vector<double> times(5, std::nan(""));  // kUniform, kFrustum, kDefault, kDefault at that tau, kThesis
  if (!allMeasures) {
    std::vector<render::FrameOptions> timed = {optionsOf(kUniform, 1.0F), optionsOf(kFrustum, 1.0F),
                                               optionsOf(kDefault, 1.0F), optionsOf(kDefault, kTaus[nearest])};
    if (thesis.triangles <= kMostTriangles) timed.push_back(optionsOf(kThesis, 1.0F));
    const std::vector<double> measured = interleavedTimes(stage, timed);
    std::copy(measured.begin(), measured.end(), times.begin());
  }
  const auto atOnePixel = [](const LvConfiguration& configuration) {
    return std::string(configuration.name) + ", tau 1";
  };
  const double toUniform = ratioAtEqualError(own, uniform, uniform);
  const double toFrustum = ratioAtEqualError(own, frustum, uniform);
  for (const Row& row :
       {Row{atOnePixel(kFrustum), frustum[kOnePixel], times[1] / times[0], ratioAtEqualError(frustum, uniform, uniform),
            1.0},
        Row{atOnePixel(kUniform), uniform[kOnePixel], 1.0, 1.0, ratioAtEqualError(uniform, frustum, uniform)},
        Row{kThesis.name, thesis, times[4] / times[0], thesis.triangles / trianglesAt(uniform, thesis.psnr),
            thesis.triangles / trianglesAt(frustum, thesis.psnr)},
        Row{atOnePixel(kDefault), own[kOnePixel], times[2] / times[0], toUniform, toFrustum},
        Row{fmt::format("the same, tau {}", kTaus[nearest]), own[nearest], times[3] / times[0], toUniform, toFrustum}})
    add(view, row, figures);
  if (!allMeasures) return;
  for (const LvConfiguration& other : kOtherMeasures) {
    const std::vector<Sample> samples = stage.sweep(other);
    add(view,
        {atOnePixel(other), samples[kOnePixel], std::nan(""), ratioAtEqualError(samples, uniform, uniform),
         ratioAtEqualError(samples, frustum, uniform)},
        figures);
  }
}

}  // namespace jalousie::bench
