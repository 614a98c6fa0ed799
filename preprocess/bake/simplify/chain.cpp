// Chooses target counts, makes the levels, measures them and decides when the chain ends.
#include "bake/simplify/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "bake/mesh/bounds.h"
#include "bake/mesh/flat_shading.h"
#include "bake/mesh/normals.h"
#include "bake/simplify/cell_levels.h"
#include "bake/simplify/collapse.h"
#include "bake/simplify/error_search.h"
#include "bake/simplify/level_maker.h"
#include "bake/simplify/measure.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

/// The object-space length of one percent.
double percentLength(const ChainOptions& options, double diagonal) {
  return 0.01 * options.reference.value_or(diagonal);
}

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
  meter.giveUp = percentLength(options, diagonal) * options.untilError;
  if (options.samples) meter.samples = *options.samples, meter.perTriangle = 0;
  return meter;
}

std::size_t levelsWanted(const ChainOptions& options) {
  if (!options.errors.empty()) return options.errors.size() + 1;
  if (!options.targets.empty()) return options.targets.size() + 1;
  return options.ratios.empty() ? std::size_t{options.levels} : options.ratios.size() + 1;
}

}  // namespace

std::uint32_t targetOf(const ChainOptions& options, std::uint32_t finest, std::size_t k) {
  if (!options.targets.empty()) return k > options.targets.size() ? 0 : options.targets[k - 1];
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

namespace {

/// What it costs to leave a mesh out: as though all of it moved into its centre, four times as far, because a removed
/// mesh leaves no surface nearby. @return  squared distance times area, object space
double removalCost(const WedgeMesh& mesh, double area) {
  constexpr double kWeight = 16.0;
  const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.vertexAt(c)]); };
  const auto sumOver = [&](const auto& value) {
    double sum = 0.0;
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
      const double own = triangleArea(mesh.positions[mesh.vertexAt(c)], mesh.positions[mesh.vertexAt(c + 1)],
                                      mesh.positions[mesh.vertexAt(c + 2)]);
      sum += own * value(corner(c), corner(c + 1), corner(c + 2));
    }
    return sum;
  };
  glm::dvec3 centre(0.0);
  for (int axis = 0; axis < 3; ++axis)
    centre[axis] =
        sumOver([&](const auto& a, const auto& b, const auto& c) { return (a[axis] + b[axis] + c[axis]) / 3.0; });
  centre /= area;
  // The mean of |p|^2 over a triangle: a sixth of the sum of all products of two corners, each pair once.
  return kWeight * sumOver([&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
           a -= centre, b -= centre, c -= centre;
           return (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) + glm::dot(a, b) + glm::dot(b, c) +
                   glm::dot(c, a)) /
                  6.0;
         });
}

}  // namespace

CostCurve costCurve(const WedgeMesh& mesh, const ChainOptions& options) {
  constexpr double kUnseen = 1e-3;  // of the diagonal
  const bool isDraft = options.preset == Preset::kDraft;
  JAL_CHECK(!isDraft);
  EdgeCollapser collapser(mesh, collapseOptions(options, flatPrimitives(mesh)));
  collapser.collapseTo(kMinLevelTriangles);
  CostCurve curve{collapser.costs(), mesh.triangles(), 0.0};
  const double diagonal = boundsOf(mesh.positions).diagonal();
  double area = 0.0;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    area += triangleArea(mesh.positions[mesh.vertexAt(c)], mesh.positions[mesh.vertexAt(c + 1)],
                         mesh.positions[mesh.vertexAt(c + 2)]);
  curve.removal = area > 0.0 ? removalCost(mesh, area) / std::max(0.5 * collapser.triangles(), 1.0) : 0.0;
  const double unit = std::pow(diagonal, 4.0);
  for (CostPoint& point : curve.points) {
    point.cost *= unit;
    // A cost is a squared distance times the area of a few triangles.
    if (point.cost * point.triangles <= area * std::pow(kUnseen * diagonal, 2.0)) curve.unseen = point.triangles;
  }
  return curve;
}

namespace {

std::string tooFew(std::uint32_t triangles) {
  return fmt::format("the next level would have fewer than {} triangles", triangles);
}

/// A level between the last one and a number of triangles that exceeds the limit, if that is a large step: the chain
/// would else end far from what the limit allows. @return  nullopt if none of those that were tried keeps it
std::optional<ChainLevel> levelBetween(const WedgeMesh& mesh, const ChainOptions& options, const DeviationMeter& meter,
                                       const ChainLevel& last, std::uint32_t target) {
  constexpr double kLeastStep = 0.6;
  constexpr int kMostAttempts = 3;
  const double limit = percentLength(options, boundsOf(mesh.positions).diagonal()) * options.untilError;
  const double most = kLeastStep * last.mesh.triangles();
  double triangles = target;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    triangles = std::sqrt(triangles * last.mesh.triangles());
    if (triangles > most) break;
    LevelMaker maker(mesh, options);
    ChainLevel level =
        measuredLevel(maker, meter, maker.make(static_cast<std::uint32_t>(std::lround(triangles)), false), last);
    const std::uint32_t made = level.mesh.triangles();
    if (made >= kMinLevelTriangles && made <= most && level.errorMax <= limit) return level;
  }
  return std::nullopt;
}

/// Makes levels one after the other and measures them.
struct NextLevel {
  /// @param finest  LOD 0, gets its cells
  NextLevel(const WedgeMesh& mesh, const ChainOptions& options, ChainLevel& finest)
      : meter(mesh, meterOptions(options, mesh.triangles(), boundsOf(mesh.positions).diagonal())) {
    if (options.cellTriangles == 0) {
      plain.emplace(mesh, options);
    } else {
      divided.emplace(mesh, options);
      finest.cells = divided->finest();
    }
  }
  ChainLevel make(std::uint32_t target, bool exactly, ChainLevel& last) {
    if (divided) return divided->next(target, meter, last);
    return measuredLevel(*plain, meter, plain->make(target, exactly), last);
  }

  DeviationMeter meter;
  std::optional<LevelMaker> plain;
  std::optional<CellLevelMaker> divided;
};

/// Levels of given numbers of triangles. @param chain  with LOD 0   @return  why there are no more levels
std::string addLevelsByCount(const WedgeMesh& mesh, const ChainOptions& options, const LevelProgress& progress,
                             std::vector<ChainLevel>& levels) {
  const std::uint32_t finest = mesh.triangles();
  const double diagonal = boundsOf(mesh.positions).diagonal();
  std::unique_ptr<NextLevel> maker;
  for (;;) {
    ChainLevel& last = levels.back();
    const std::size_t k = levels.size();
    std::uint32_t target = targetOf(options, finest, k);
    if (target == 0 && k >= levelsWanted(options))
      return options.isShare ? "no coarser level of the scene has fewer triangles of it" : "all levels made";
    if (options.untilTriangles && target < *options.untilTriangles) return tooFew(*options.untilTriangles);
    // A step that leads too far down ends at the smallest level, if that is a step worth making.
    if (target < kMinLevelTriangles && last.mesh.triangles() >= 2 * kMinLevelTriangles) target = kMinLevelTriangles;
    if (target < kMinLevelTriangles || target >= last.mesh.triangles())
      return fmt::format("the next level would have {} triangles", target);
    if (!maker) maker = std::make_unique<NextLevel>(mesh, options, last);
    const bool exactly = options.coarsest && k + 1 == options.levels;
    ChainLevel next = maker->make(target, exactly, last);
    const std::uint32_t triangles = next.mesh.triangles();
    if (triangles < kMinLevelTriangles)
      return fmt::format("simplification fell below {} triangles", kMinLevelTriangles);
    if (triangles > last.mesh.triangles() * 0.95 && triangles > target)
      return fmt::format("asked for {} triangles, edge collapse stops at {}", target, triangles);
    if (next.errorMax > percentLength(options, diagonal) * options.untilError) {
      std::optional<ChainLevel> between;
      if (options.cellTriangles == 0) between = levelBetween(mesh, options, maker->meter, last, target);
      if (between) levels.push_back(std::move(*between));
      return fmt::format("the next level, of {} triangles, would be off by {:.3g} % of the diagonal", triangles,
                         100.0 * next.errorMax / diagonal);
    }
    levels.push_back(std::move(next));
    if (progress) progress({k, levelsWanted(options), triangles});
  }
}

/// Levels of given errors. Parameters as for addLevelsByCount
std::string addLevelsByError(const WedgeMesh& mesh, const ChainOptions& options, const LevelProgress& progress,
                             std::vector<ChainLevel>& levels) {
  const double diagonal = boundsOf(mesh.positions).diagonal();
  DeviationMeter meter(mesh, meterOptions(options, mesh.triangles(), diagonal));
  ErrorSearch search(mesh, options, meter);
  std::string unreached;
  for (std::size_t i = 0; i < options.errors.size(); ++i) {
    const double target = percentLength(options, diagonal) * options.errors[i];
    std::optional<ChainLevel> next = search.next(levels.back(), target - options.errorReserve);
    if (!next) {
      unreached += fmt::format("{}{:g} %", unreached.empty() ? "" : ", ", options.errors[i]);
      continue;
    }
    if (options.untilTriangles && next->mesh.triangles() < *options.untilTriangles)
      return tooFew(*options.untilTriangles);
    next->target = target;
    levels.push_back(std::move(*next));
    if (progress) progress({i + 1, options.errors.size() + 1, levels.back().mesh.triangles()});
  }
  return unreached.empty()
             ? "all levels made"
             : fmt::format("no level of fewer triangles than the one before has an error of {}", unreached);
}

}  // namespace

LevelChain makeChain(const WedgeMesh& mesh, const ChainOptions& options, const LevelProgress& progress) {
  JAL_CHECK(mesh.corners.size() >= 3U);
  LevelChain chain;
  chain.levels.emplace_back().mesh = mesh;
  chain.stopReason = options.errors.empty() ? addLevelsByCount(mesh, options, progress, chain.levels)
                                            : addLevelsByError(mesh, options, progress, chain.levels);
  if (std::optional<CellDivision>& last = chain.levels.back().cells) last->groupOf.clear(), last->errors.clear();
  chain.endsInNothing = options.leftOut;
  if (options.leftOut) chain.stopReason += "; below the last level the mesh is left out, it is too small to matter";
  return chain;
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
  // Left out, a mesh is off by its diameter.
  const double least = std::numbers::pi * tolerance.pixels * tolerance.pixels / 4.0 / screenPixels;
  coverage.push_back(chain.endsInNothing ? static_cast<float>(std::min(last, least)) : 0.0F);
  return coverage;
}

}  // namespace jalousie::bake
