// Cost at equal image error: sweeps over tau against both baselines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/image_error.h"
#include "gl_bench.h"
#include "lv_setup.h"
#include "lv_sweep.h"
#include "lv_times.h"

namespace jalousie::bench {
namespace {

constexpr int kRounds = 7;

/// One line of the table. Ratios that were not measured are NaN.
struct Row {
  std::string name;
  Sample sample;
  double time;       ///< over that of kUniform at tau = 1
  double toUniform;  ///< triangles at equal PSNR over those of kUniform
  double toFrustum;  ///< likewise of kFrustum
};

void add(const LvView& view, const Row& row, nlohmann::ordered_json& figures) {
  fmt::print("| {} | {:.0f} | {:.2f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} |\n", row.name, row.sample.triangles,
             row.sample.psnr, row.sample.ssim, row.time, row.toUniform, row.toFrustum);
  std::fflush(stdout);
  figures.push_back({{"scene", view.sceneName},
                     {"view", view.text},
                     {"configuration", row.name},
                     {"triangles", row.sample.triangles},
                     {"psnr", orNull(row.sample.psnr)},
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
  require(std::isinf(compare::psnr(stage.reference.image, stage.renderer.readImage())),
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
  stage.reference.image = settledImage(renderer, finestOptions(/*twoPhases=*/false), stage.camera);
  requireReference(stage);
  const auto sweep = [&](const LvConfiguration& configuration) {
    return stage.sweep(optionsOf(configuration, 1.0F), kTaus, configuration.name);
  };
  const std::vector<Sample> uniform = sweep(kUniform);
  const std::vector<Sample> frustum = sweep(kFrustum);
  const std::vector<Sample> own = sweep(kDefault);
  const Sample thesis = stage.sample(optionsOf(kThesis, 1.0F));
  printHead(view);

  // Times at about equal error: the tau at which the default's PSNR is nearest to the baseline's at one pixel.
  const std::size_t nearest = nearestPsnr(own, uniform[kOnePixel].psnr);
  std::vector<double> times(5, std::nan(""));  // kUniform, kFrustum, kDefault, kDefault at that tau, kThesis
  if (!allMeasures) {
    std::vector<Timed> timed = {{renderer, optionsOf(kUniform, 1.0F)},
                                {renderer, optionsOf(kFrustum, 1.0F)},
                                {renderer, optionsOf(kDefault, 1.0F)},
                                {renderer, optionsOf(kDefault, kTaus[nearest])}};
    if (thesis.triangles <= kMostTriangles) timed.push_back({renderer, optionsOf(kThesis, 1.0F)});
    const std::vector<double> measured = interleavedTimes(timed, stage.camera, kRounds);
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
        Row{kThesis.name, thesis, times[4] / times[0], thesis.triangles / trianglesAt(uniform, kPsnr, thesis.psnr),
            thesis.triangles / trianglesAt(frustum, kPsnr, thesis.psnr)},
        Row{atOnePixel(kDefault), own[kOnePixel], times[2] / times[0], toUniform, toFrustum},
        Row{fmt::format("the same, tau {}", kTaus[nearest]), own[nearest], times[3] / times[0], toUniform, toFrustum}})
    add(view, row, figures);
  if (!allMeasures) return;
  for (const LvConfiguration& other : kOtherMeasures) {
    const std::vector<Sample> samples = sweep(other);
    add(view,
        {atOnePixel(other), samples[kOnePixel], std::nan(""), ratioAtEqualError(samples, uniform, uniform),
         ratioAtEqualError(samples, frustum, uniform)},
        figures);
  }
}

}  // namespace jalousie::bench
