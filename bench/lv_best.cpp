// How far the rule `price` is from the best choice of one level per object, which knows the errors of all levels.
//
// Every object is drawn at each of its levels. The squared error of a pixel against the finest levels belongs to the
// object that came to the front there, or that no longer is in front. At a price L of a triangle, the best choice takes
// for each object the level with the least error + L * triangles. How large the error of a level is depends on the
// levels of the other objects, so each choice is drawn, the errors are measured again, and the choice is made anew. The
// levels that `price` chose are measured, too. The figures are those of drawn pictures; a better choice may exist.
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
double priceAt(int i) {
  return std::exp2(2 * (6 - i));
}
constexpr int kRounds = 4;  // of choosing, at each price

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

/// Levels of the objects, and what is known about the errors of all levels.
class Choice {
 public:
  Choice(const LvView& view, const Reference& reference, const LayerPixels& finest)
      : view_(view), reference_(reference), finest_(finest), errors_(levelErrors(view, finest)) {}

  /// Draws the choices that follow from the errors of objects drawn all at one level.
  void start() {
    std::vector<std::vector<std::uint32_t>> choices;
    choices.reserve(kPrices);
    for (int i = 0; i < kPrices; ++i)
      choices.push_back(choose(priceAt(i)));
    for (const std::vector<std::uint32_t>& levels : choices)
      if (!measure(levels)) return;
  }

  /// Learns from levels that a rule chose. @param renderer  shows a frame of the scene with all its levels
  void learnFrom(render::FrameRenderer& renderer) {
    const std::vector<gpu::ObjectState> states = renderer.readStates();
    std::vector<std::uint32_t> levels;
    levels.reserve(states.size());
    for (std::size_t object = 0; object < states.size(); ++object)
      levels.push_back(std::min(states[object].lod, chainOf(object).lodCount - 1));
    measure(levels);
  }

  /// Chooses, draws and learns. Adds what it drew to the samples.
  void refine(double price) {
    for (int round = 0; round < kRounds; ++round)
      if (!measure(choose(price))) return;
  }

  /// The samples that no other one beats in triangles and PSNR, dearest last.
  std::vector<Sample> best() const {
    std::vector<Sample> sorted = samples_;
    std::ranges::sort(sorted, {}, &Sample::triangles);
    std::vector<Sample> front;
    for (const Sample& sample : sorted)
      if (front.empty() || sample.psnr > front.back().psnr) front.push_back(sample);
    return front;
  }

 private:
  const gpu::Chain& chainOf(std::size_t object) const { return view_.scene.chains[view_.scene.objects[object].chain]; }

  /// The level with the least error + price * triangles for each object; of equal ones, the coarsest.
  std::vector<std::uint32_t> choose(double price) const {
    std::vector<std::uint32_t> levels(view_.scene.objects.size(), 0);
    for (std::size_t object = 0; object < levels.size(); ++object) {
      const gpu::Chain& chain = chainOf(object);
      const auto cost = [&](std::uint32_t level) {
        return errors_[level][object] + price * view_.scene.lods[chain.firstLod + level].triangleCount;
      };
      for (std::uint32_t level = 1; level < chain.lodCount; ++level)
        if (cost(level) <= cost(levels[object])) levels[object] = level;
    }
    return levels;
  }

  /// Draws the objects at some levels, keeps the sample, and replaces the errors of these levels by those that were
  /// seen; coarser ones are at least as large. @return  false if the frame has too many triangles to go on
  bool measure(const std::vector<std::uint32_t>& levels) {
    const scene::SceneData scene = atLevels(view_.scene, levels);
    render::FrameRenderer renderer(scene, kWidth, kHeight);
    Stage stage{renderer, view_.camera(), reference_};
    samples_.push_back(stage.sample(finestOptions(/*twoPhases=*/true)));
    LayerPixels pixels = drawAll(renderer, view_.camera());
    // The objects of this scene are in another order; their owners are the same.
    std::vector<std::uint32_t> byOwner(levels.size());
    for (std::uint32_t object = 0; object < levels.size(); ++object)
      byOwner[view_.scene.objects[object].owner] = object;
    for (std::uint32_t& id : pixels.ids)
      if (id != 0) id = byOwner[scene.objects[id - 1].owner] + 1;
    std::vector<double> seen(levels.size(), 0.0);
    attribute(finest_, pixels, seen);
    for (std::size_t object = 0; object < levels.size(); ++object) {
      errors_[levels[object]][object] = seen[object];
      for (std::uint32_t level = levels[object] + 1; level < chainOf(object).lodCount; ++level)
        errors_[level][object] = std::max(errors_[level][object], seen[object]);
    }
    return samples_.back().triangles <= kMostTriangles;
  }

  const LvView& view_;
  const Reference& reference_;
  const LayerPixels& finest_;
  std::vector<std::vector<double>> errors_;  ///< [levels][objects]
  std::vector<Sample> samples_;
};

std::string text(double ratio) {
  return std::isnan(ratio) ? "-" : fmt::format("{:.2f}", ratio);
}

}  // namespace

void measureBest(const LvView& view, nlohmann::ordered_json& figures) {
  render::FrameRenderer renderer(view.scene, kWidth, kHeight);
  Stage stage{renderer, view.camera(), coveredReference(renderer, view.camera())};
  const LayerPixels finest = drawAll(renderer, stage.camera);
  const std::vector<Sample> uniform = stage.sweep(optionsOf(kUniform, 1.0F), kTaus, kUniform.name);
  Choice choice(view, stage.reference, finest);
  choice.start();
  std::vector<Sample> price;
  for (const float tau : kTaus) {
    price.push_back(stage.sample(optionsOf(kDefault, tau)));
    if (price.back().triangles > kMostTriangles) break;
    choice.learnFrom(renderer);
  }
  requireImproves(price, kDefault.name);
  for (int i = 0; i < kPrices; ++i)
    choice.refine(priceAt(i));
  const std::vector<Sample> best = choice.best();
  nlohmann::ordered_json row = {{"scene", view.sceneName}, {"view", view.text}};
  std::array<std::string, 2> cells;
  const std::pair<const char*, const std::vector<Sample>&> rules[] = {{"price", price}, {"best", best}};
  for (std::size_t rule = 0; rule < 2; ++rule) {
    for (const ErrorMeasure& measure : kMeasures) {
      const double ratio = ratioAtEqualError(rules[rule].second, uniform, uniform, measure);
      row[rules[rule].first][measure.name] = orNull(ratio);
      cells[rule] += (cells[rule].empty() ? "" : ", ") + text(ratio);
    }
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
