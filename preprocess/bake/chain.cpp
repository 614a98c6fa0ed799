// Targets, stops and measured errors of a chain.
#include "bake/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bake/measure.h"
#include "bake/simplify.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

double ratioOf(const ChainOptions& options, std::uint32_t triangles) {
  if (!options.coarsest || options.levels < 2) return options.ratio;
  return std::pow(static_cast<double>(*options.coarsest) / triangles, 1.0 / (options.levels - 1));
}

/// Collapses can undershoot; a slightly larger target often lands on the wanted count.
std::vector<std::uint32_t> simplifyExactly(const CombinedMesh& mesh, const std::vector<std::uint32_t>& from,
                                           std::uint32_t target) {
  std::vector<std::uint32_t> best = simplifyTriangles(mesh, from, target);
  const auto miss = [&](const std::vector<std::uint32_t>& indices) {
    return std::abs(static_cast<std::int64_t>(indices.size() / 3) - static_cast<std::int64_t>(target));
  };
  for (std::uint32_t extra = 1; extra <= 32 && miss(best) > 0; ++extra) {
    std::vector<std::uint32_t> candidate = simplifyTriangles(mesh, from, target + extra);
    if (miss(candidate) < miss(best)) best = std::move(candidate);
  }
  return best;
}

}  // namespace

LevelChain makeChain(const CombinedMesh& mesh, const ChainOptions& options) {
  JAL_CHECK(mesh.indices.size() >= 3U);
  LevelChain chain;
  chain.levels.push_back({mesh.indices, 0.0, 0.0});
  const std::uint32_t finest = chain.levels[0].triangles();
  const double ratio = ratioOf(options, finest);
  const DeviationMeter meter({mesh.positions, mesh.indices}, options.samples);
  while (chain.levels.size() < options.levels) {
    const ChainLevel& last = chain.levels.back();
    const auto k = static_cast<double>(chain.levels.size());
    const bool isLast = chain.levels.size() + 1 == options.levels;
    auto target = static_cast<std::uint32_t>(std::lround(finest * std::pow(ratio, k)));
    if (options.coarsest && isLast) target = *options.coarsest;
    if (target < kMinLevelTriangles || target >= last.triangles()) {
      chain.stopReason = fmt::format("the next level would have {} triangles", target);
      return chain;
    }
    ChainLevel next;
    next.indices = options.coarsest && isLast ? simplifyExactly(mesh, last.indices, target)
                                              : simplifyTriangles(mesh, last.indices, target);
    if (next.triangles() < kMinLevelTriangles) {
      chain.stopReason = fmt::format("simplification fell below {} triangles", kMinLevelTriangles);
      return chain;
    }
    if (next.triangles() > last.triangles() * 0.95) {
      chain.stopReason = fmt::format("asked for {} triangles, edge collapse stops at {}", target, next.triangles());
      return chain;
    }
    const Deviation deviation = meter.measure({mesh.positions, next.indices});
    next.errorMax = std::max(deviation.max, last.errorMax);
    next.errorMean = std::max(deviation.mean, last.errorMean);
    chain.levels.push_back(std::move(next));
  }
  chain.stopReason = "all levels made";
  return chain;
}

std::vector<float> screenCoverage(const LevelChain& chain, double radius) {
  constexpr double kScreenPixels = 1920.0 * 1080.0;
  std::vector<float> coverage;
  double last = 1.0;
  for (std::size_t k = 0; k + 1 < chain.levels.size(); ++k) {
    const double error = chain.levels[k + 1].errorMax;
    const double diameter = error > 0.0 ? 2.0 * radius / error : 1e9;
    last = std::min(last, std::numbers::pi * diameter * diameter / 4.0 / kScreenPixels);
    coverage.push_back(static_cast<float>(last));
  }
  coverage.push_back(0.0F);
  return coverage;
}

}  // namespace jalousie::bake
