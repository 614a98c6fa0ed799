// How far the rule `price` is from the best choice of one level per object, which knows the errors of all levels.
//
// Every object is drawn at each of its levels. The squared error of a pixel against the finest levels belongs to the
// object that came to the front there, or that no longer is in front. At a price L of a triangle, the best choice takes
// for each object the level with the least error + L * triangles. The scenes of these choices are then drawn and
// measured, so the errors of the levels only guide the choice.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "gl_bench.h"
#include "lv_setup.h"
#include "lv_sweep.h"

namespace jalousie::bench {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;
/// Prices of a triangle, squared differences of 8-bit channels: 4^6 to 4^-5.
constexpr int kPrices = 12;
double priceAt(int i) { return std::exp2(2 * (6 - i)); }

/// What a pixel shows, from all objects at one level.
struct LayerPixels {
  ImageRgba8 image;                ///< row 0 at the top
  std::vector<float> depth;        ///< reversed; row 0 at the bottom
  std::vector<std::uint32_t> ids;  ///< object index + 1; row 0 at the bottom
};

LayerPixels drawAll(render::FrameRenderer& renderer, const scene::Camera& camera) {
  LayerPixels pixels;
  pixels.image = settledImage(renderer, finestOptions(/*twoPhases=*/false), camera);
  pixels.depth = renderer.readDepth();
  renderer.renderIds();
  pixels.ids = renderer.readIds();
  return pixels;
}

/// The scene with each object at one level of its chain, which becomes its only one.
/// @param levels  [objects.size()]; beyond the chain's end: its coarsest level
scene::SceneData atLevels(const scene::SceneData& scene, const std::vector<std::uint32_t>& levels) {
  scene::SceneData chosen = scene;
  const auto chainOf = [&](std::uint32_t object) {
    const std::uint32_t chain = scene.objects[object].chain;
    return std::pair(chain, std::min(levels[object], scene.chains[chain].lodCount - 1));
  };
  std::vector<std::uint32_t> order(scene.objects.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, chainOf);
  chosen.chains.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const auto key = chainOf(order[i]);
    const auto [entry, isNew] = made.try_emplace(key, static_cast<std::uint32_t>(chosen.chains.size()));
    if (isNew) {
      chosen.chains.push_back(scene.chains[key.first]);
      chosen.chains.back().firstLod += key.second;
      chosen.chains.back().lodCount = 1;
    }
    chosen.objects[i] = scene.objects[order[i]];
    chosen.objects[i].chain = entry->second;
    chosen.objects[i].object = i;
  }
  chosen.binLayout = scene::layoutBins(chosen.chains, chosen.objects, chosen.lods, /*patches=*/false);
  return chosen;
}

double squaredDifference(const std::uint8_t* a, const std::uint8_t* b) {
  double sum = 0.0;
  for (int channel = 0; channel < 3; ++channel)
    sum += std::pow(double{static_cast<double>(a[channel])} - b[channel], 2);
  return sum;
}

/// Adds the squared error of a level to the objects that caused it.
/// @param errors  [objects]
void attribute(const LayerPixels& finest, const LayerPixels& level, std::vector<double>& errors) {
  const std::size_t width = finest.image.width;
  const std::size_t height = finest.image.height;
  for (std::size_t at = 0; at < finest.ids.size(); ++at) {
    const std::size_t flipped = (height - 1 - at / width) * width + at % width;
    const double error = squaredDifference(&finest.image.pixels[flipped * 4], &level.image.pixels[flipped * 4]);
    const std::uint32_t id = level.depth[at] > finest.depth[at] ? level.ids[at] : finest.ids[at];
    if (error > 0.0 && id != 0) errors[id - 1] += error;
  }
}

/// Squared error of each object at each level: [levels][objects].
std::vector<std::vector<double>> levelErrors(const LvView& view, const LayerPixels& finest) {
  std::uint32_t levels = 1;
  for (const gpu::Chain& chain : view.scene.chains)
    levels = std::max(levels, chain.lodCount);
  std::vector<std::vector<double>> errors(levels, std::vector<double>(view.scene.objects.size(), 0.0));
  for (std::uint32_t level = 1; level < levels; ++level) {
    const scene::SceneData scene = atLevels(view.scene, std::vector(view.scene.objects.size(), level));
    render::FrameRenderer renderer(scene, kWidth, kHeight);
    attribute(finest, drawAll(renderer, view.camera()), errors[level]);
    fmt::print(stderr, "{}, view {}: level {} of {}\n", view.sceneName, view.text, level, levels - 1);
  }
  return errors;
}

/// The level with the least error + price * triangles for each object; of equal ones, the coarsest.
std::vector<std::uint32_t> choose(const scene::SceneData& scene, const std::vector<std::vector<double>>& errors,
                                  double price) {
  std::vector<std::uint32_t> levels(scene.objects.size(), 0);
  for (std::size_t object = 0; object < levels.size(); ++object) {
    const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
    const auto cost = [&](std::uint32_t level) {
      return errors[level][object] + price * scene.lods[chain.firstLod + level].triangleCount;
    };
    for (std::uint32_t level = 1; level < chain.lodCount; ++level)
      if (cost(level) <= cost(levels[object])) levels[object] = level;
  }
  return levels;
}

/// Samples of the best choices, dearest triangles first.
std::vector<Sample> bestSamples(const LvView& view, const Reference& reference, const LayerPixels& finest) {
  const std::vector<std::vector<double>> errors = levelErrors(view, finest);
  std::vector<Sample> samples;
  for (int i = 0; i < kPrices; ++i) {
    const scene::SceneData scene = atLevels(view.scene, choose(view.scene, errors, priceAt(i)));
    render::FrameRenderer renderer(scene, kWidth, kHeight);
    Stage stage{renderer, view.camera(), reference};
    samples.push_back(stage.sample(finestOptions(/*twoPhases=*/true)));
    if (samples.back().triangles > kMostTriangles) break;
  }
  requireImproves(samples, "best choice");
  return samples;
}

std::string text(double ratio) { return std::isnan(ratio) ? "-" : fmt::format("{:.2f}", ratio); }

}  // namespace

void measureBest(const LvView& view, nlohmann::ordered_json& figures) {
  render::FrameRenderer renderer(view.scene, kWidth, kHeight);
  Stage stage{renderer, view.camera(), coveredReference(renderer, view.camera())};
  const LayerPixels finest = drawAll(renderer, stage.camera);
  const std::vector<Sample> uniform = stage.sweep(optionsOf(kUniform, 1.0F), kTaus, kUniform.name);
  const std::vector<Sample> price = stage.sweep(optionsOf(kDefault, 1.0F), kTaus, kDefault.name);
  const std::vector<Sample> best = bestSamples(view, stage.reference, finest);
  nlohmann::ordered_json row = {{"scene", view.sceneName}, {"view", view.text}};
  std::array<std::string, 2> cells;
  const std::pair<const char*, const std::vector<Sample>&> rules[] = {{"price", price}, {"best", best}};
  for (std::size_t rule = 0; rule < 2; ++rule)
    for (const ErrorMeasure& measure : kMeasures) {
      const double ratio = ratioAtEqualError(rules[rule].second, uniform, uniform, measure);
      row[rules[rule].first][measure.name] = orNull(ratio);
      cells[rule] += (cells[rule].empty() ? "" : ", ") + text(ratio);
    }
  const double rest = ratioAtEqualError(best, price, uniform);
  row["best_over_price_psnr"] = orNull(rest);
  figures.push_back(row);
  fmt::print("| {}, {} | {} | {} | {} |\n", view.sceneName, view.text, cells[0], cells[1], text(rest));
  std::fflush(stdout);
}

void printBestHead() {
  fmt::print(
      "Triangles over hiz + pixel-error at equal PSNR, SSIM, FLIP; one level per whole object\n"
      "| view | price | best choice | best choice / price, PSNR |\n|---|---|---|---|\n");
}

}  // namespace jalousie::bench
