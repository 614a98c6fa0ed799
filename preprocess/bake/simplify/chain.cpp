// Chooses target counts, makes the levels, measures them and decides when the chain ends.
#include "bake/simplify/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "bake/mesh/bounds.h"
#include "bake/simplify/collapse.h"
#include "bake/simplify/draft.h"
#include "bake/simplify/measure.h"
#include "bake/simplify/refit.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

/// Makes the levels of one chain, one after the other.
class LevelMaker {
 public:
  LevelMaker(const WedgeMesh& mesh, const ChainOptions& options) : finest_(mesh), options_(options) {
    if (options.preset == Preset::kDraft) {
      corners_ = mesh.corners;
      return;
    }
    CollapseOptions collapse = options.collapse;
    if (options.preset == Preset::kFast && !collapse.normalWeight) collapse.normalWeight = 0.0;
    collapser_ = std::make_unique<EdgeCollapser>(mesh, collapse);
  }

  /// Collapses to a level of at most `target` triangles if the collapse allows it.
  /// @param vertexMap  from the finest mesh
  WedgeMesh make(std::uint32_t target, bool exactly, std::vector<std::uint32_t>& vertexMap) {
    if (!collapser_) {
      corners_ = exactly ? draftExactly(target) : draftCorners(finest_, corners_, target, options_.collapse.lockBorder);
      DraftLevel level = draftLevel(finest_, corners_);
      vertexMap = std::move(level.vertexMap);
      return std::move(level.mesh);
    }
    collapser_->collapseTo(target);
    WedgeMesh level = collapser_->mesh();
    vertexMap = collapser_->vertexMap();
    return level;
  }

  /// Fits a level to the finest mesh, unless it is a draft. @pre the level has at least kMinLevelTriangles
  void refit(const std::vector<std::uint32_t>& vertexMap, WedgeMesh& level) const {
    if (collapser_) refitLevel(finest_, vertexMap, refitOptions(), level);
  }

 private:
  RefitOptions refitOptions() const {
    RefitOptions refit;
    refit.lockBorder = options_.collapse.lockBorder;
    refit.slices = options_.slices;
    if (options_.preset == Preset::kFast) {
      refit.rounds = 1;
      refit.samplesPerTriangle = 3;
      refit.mostSamples = 1.0;
    }
    return refit;
  }

  /// A collapse can undershoot its target; a slightly larger target often gives the wanted count.
  std::vector<std::uint32_t> draftExactly(std::uint32_t target) const {
    std::vector<std::uint32_t> best = draftCorners(finest_, corners_, target, options_.collapse.lockBorder);
    const auto miss = [&](const std::vector<std::uint32_t>& corners) {
      return std::abs(static_cast<std::int64_t>(corners.size() / 3) - static_cast<std::int64_t>(target));
    };
    for (std::uint32_t extra = 1; extra <= 32 && miss(best) > 0; ++extra) {
      std::vector<std::uint32_t> candidate =
          draftCorners(finest_, corners_, target + extra, options_.collapse.lockBorder);
      if (miss(candidate) < miss(best)) best = std::move(candidate);
    }
    return best;
  }

  const WedgeMesh& finest_;
  const ChainOptions& options_;
  std::unique_ptr<EdgeCollapser> collapser_;
  std::vector<std::uint32_t> corners_;  ///< drafts only
};

/// The cost of the measure follows the size of the mesh; large meshes have the figures of the preset.
MeterOptions meterOptions(const ChainOptions& options, std::uint32_t triangles, double diagonal) {
  const bool best = options.preset == Preset::kBest;
  MeterOptions meter;
  meter.slices = options.slices;
  meter.perTriangle = best ? 48 : 8;
  meter.closeEnough = best ? 1.02 : 1.05;
  if (options.preset == Preset::kFast) meter.samples = 12000, meter.searches = 10000;
  if (options.preset == Preset::kDraft) meter.samples = 10000, meter.searches = 5000;
  meter.searches = std::min(meter.searches, (best ? 16U : 4U) * std::min(16 + triangles, 1U << 20U));
  meter.giveUp = options.untilError * 0.01 * diagonal;
  if (options.samples) meter.samples = *options.samples, meter.perTriangle = 0;
  return meter;
}

/// Wanted triangles of level k; 0 if the options ask for no such level.
std::uint32_t targetOf(const ChainOptions& options, std::uint32_t finest, std::size_t k) {
  if (!options.ratios.empty()) {
    if (k > options.ratios.size()) return 0;
    return static_cast<std::uint32_t>(std::lround(finest * options.ratios[k - 1]));
  }
  if (k >= options.levels) return 0;
  if (options.coarsest && k + 1 == options.levels) return *options.coarsest;
  const double ratio = options.coarsest
                           ? std::pow(static_cast<double>(*options.coarsest) / finest, 1.0 / (options.levels - 1))
                           : options.ratio;
  return static_cast<std::uint32_t>(std::lround(finest * std::pow(ratio, static_cast<double>(k))));
}

}  // namespace

LevelChain makeChain(const WedgeMesh& mesh, const ChainOptions& options,
                     const std::function<void(std::uint32_t)>& progress) {
  JAL_CHECK(mesh.corners.size() >= 3U);
  LevelChain chain;
  chain.levels.push_back({mesh, {}, 0.0});
  const std::uint32_t finest = mesh.triangles();
  const double diagonal = boundsOf(mesh.positions).diagonal();
  std::unique_ptr<LevelMaker> maker;
  std::unique_ptr<DeviationMeter> meter;
  const auto stop = [&](std::string reason) {
    chain.stopReason = std::move(reason);
    return std::move(chain);
  };
  for (;;) {
    const ChainLevel& last = chain.levels.back();
    const std::size_t k = chain.levels.size();
    const std::uint32_t target = targetOf(options, finest, k);
    if (target == 0 && k >= (options.ratios.empty() ? std::size_t{options.levels} : options.ratios.size() + 1))
      return stop("all levels made");
    if (options.untilTriangles && target < *options.untilTriangles)
      return stop(fmt::format("the next level would have fewer than {} triangles", *options.untilTriangles));
    if (target < kMinLevelTriangles || target >= last.mesh.triangles())
      return stop(fmt::format("the next level would have {} triangles", target));
    if (!maker) {
      maker = std::make_unique<LevelMaker>(mesh, options);
      meter = std::make_unique<DeviationMeter>(mesh, meterOptions(options, finest, diagonal));
    }
    std::vector<std::uint32_t> vertexMap;
    const bool exactly = options.coarsest && k + 1 == options.levels;
    ChainLevel next{maker->make(target, exactly, vertexMap), {}, 0.0};
    const std::uint32_t triangles = next.mesh.triangles();
    if (triangles < kMinLevelTriangles)
      return stop(fmt::format("simplification fell below {} triangles", kMinLevelTriangles));
    if (triangles > last.mesh.triangles() * 0.95 && triangles > target)
      return stop(fmt::format("asked for {} triangles, edge collapse stops at {}", target, triangles));
    maker->refit(vertexMap, next.mesh);
    next.deviation = meter->measure(next.mesh, vertexMap);
    next.errorMax = std::max(next.deviation.twoSided.max, last.errorMax);
    if (next.errorMax > options.untilError * 0.01 * diagonal)
      return stop(fmt::format("the next level, of {} triangles, would be off by {:.3g} % of the diagonal", triangles,
                              100.0 * next.errorMax / diagonal));
    chain.levels.push_back(std::move(next));
    if (progress) progress(triangles);
  }
}

std::vector<float> screenCoverage(const LevelChain& chain, double radius, const ScreenTolerance& tolerance) {
  const double screenPixels = tolerance.height * tolerance.height * 16.0 / 9.0;
  std::vector<float> coverage;
  double last = 1.0;
  for (std::size_t k = 0; k + 1 < chain.levels.size(); ++k) {
    const double error = chain.levels[k + 1].errorMax;
    const double diameter = error > 0.0 ? 2.0 * radius * tolerance.pixels / error : 1e9;
    last = std::min(last, std::numbers::pi * diameter * diameter / 4.0 / screenPixels);
    coverage.push_back(static_cast<float>(last));
  }
  coverage.push_back(0.0F);
  return coverage;
}

}  // namespace jalousie::bake
