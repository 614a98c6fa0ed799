// Brackets the number of triangles between a level that keeps the limit and one that exceeds it.
#include "bake/simplify/error_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bake/mesh/triangle_bvh.h"

namespace jalousie::bake {
namespace {

constexpr double kCloseEnough = 0.98;  // of the limit
constexpr double kNarrow = 0.99;       // of the triangles
constexpr int kMostAttempts = 24;
constexpr int kMostTries = 8;  // of one attempt, with more parts that stay

/// Triangles that were asked for, and the error that came of it.
struct Attempt {
  double triangles = 0.0;
  double error = 0.0;
};

/// The bracket of one search: `kept` has the more triangles and keeps the limit, `exceeded` does not.
struct Bracket {
  Attempt kept;
  std::optional<Attempt> exceeded;

  bool isNarrow() const {
    const double low = exceeded ? exceeded->triangles : kMinLevelTriangles - 1.0;
    return kept.triangles - low <= 1.0 || low > kNarrow * kept.triangles;
  }

  /// Triangles to try next. Errors follow a power of the number of triangles, but unevenly: no attempt lies close to an
  /// end of the bracket.
  std::uint32_t next(double limit) const {
    const double aim = 0.5 * (1.0 + kCloseEnough) * limit;
    double share = 0.5;  // of the way down, in the logarithm of the triangles
    const double low = exceeded ? exceeded->triangles : std::max(kMinLevelTriangles - 1.0, 0.25 * kept.triangles);
    if (exceeded && kept.error > 0.0 && exceeded->error > kept.error)
      share = std::clamp(std::log(aim / kept.error) / std::log(exceeded->error / kept.error), 0.1, 0.9);
    const double triangles = kept.triangles * std::pow(low / kept.triangles, share);
    const auto inside = std::clamp(std::floor(triangles), std::floor(low) + 1.0, kept.triangles - 1.0);
    return static_cast<std::uint32_t>(inside);
  }
};

}  // namespace

ChainLevel measuredLevel(const LevelMaker& maker, const DeviationMeter& meter, LevelMaker::Level made,
                         const ChainLevel& last) {
  const bool measures = made.mesh.triangles() >= kMinLevelTriangles;
  ChainLevel level;
  if (measures) {
    maker.refit(made);
    level.deviation = meter.measure(made.mesh, made.vertexMap);
    level.errorMax = std::max(level.deviation.twoSided.max, last.errorMax);
  }
  level.mesh = std::move(made.mesh);
  level.removedParts = made.removedParts;
  return level;
}

ErrorSearch::ErrorSearch(const WedgeMesh& mesh, const ChainOptions& options, DeviationMeter& meter)
    : mesh_(mesh), maker_(std::make_unique<LevelMaker>(mesh, options)), meter_(meter) {}

/// Notes the parts that the level is without although they are further from it than the limit. @return  whether there
/// are any
bool ErrorSearch::keepLostParts(const LevelMaker& maker, const LevelMaker::Level& level, double limit) {
  if (maker.collapser() == nullptr || level.removedParts == 0) return false;
  const PartClasses& classes = maker.collapser()->partClasses();
  const TriangleBvh bvh(level.mesh.positions, vertexIndices(level.mesh));
  bool found = false;
  for (std::uint32_t v = 0; v < level.vertexMap.size(); ++v) {
    if (level.vertexMap[v] != EdgeCollapser::kGone) continue;
    const std::uint32_t part = classes.partOfVertex[v];
    if (!keep_.empty() && keep_[part] != 0) continue;
    if (bvh.nearest(mesh_.positions[v]).distance2 <= limit * limit) continue;
    keep_.resize(classes.classOf.size(), 0);
    keep_[part] = 1;
    found = true;
  }
  return found;
}

/// Collapses a copy of the last level, again if parts would be missed.
LevelMaker::Level ErrorSearch::make(std::unique_ptr<LevelMaker>& maker, std::uint32_t triangles, double limit) {
  for (int tries = 0;; ++tries) {
    maker = std::make_unique<LevelMaker>(*maker_);
    if (maker->collapser() != nullptr) maker->collapser()->keepParts(keep_);
    LevelMaker::Level level = maker->make(triangles, false);
    if (level.mesh.triangles() < kMinLevelTriangles || tries == kMostTries || !keepLostParts(*maker, level, limit))
      return level;
  }
}

std::optional<ChainLevel> ErrorSearch::next(const ChainLevel& last, double limit) {
  if (limit < last.errorMax) return std::nullopt;
  meter_.giveUpAbove(limit);
  keep_.clear();
  std::optional<ChainLevel> best;
  Bracket bracket{{static_cast<double>(last.mesh.triangles()), last.errorMax}, std::nullopt};
  for (int attempt = 0; attempt < kMostAttempts && !bracket.isNarrow(); ++attempt) {
    const std::uint32_t asked = bracket.next(limit);
    std::unique_ptr<LevelMaker> maker;
    LevelMaker::Level made = make(maker, asked, limit);
    ChainLevel level = measuredLevel(*maker, meter_, std::move(made), last);
    const std::uint32_t triangles = level.mesh.triangles();
    if (triangles >= bracket.kept.triangles) break;  // no collapse is left
    if (triangles < kMinLevelTriangles || level.errorMax > limit) {
      bracket.exceeded = Attempt{static_cast<double>(asked), std::max(level.errorMax, limit)};
      continue;
    }
    bracket.kept = {static_cast<double>(triangles), level.errorMax};
    maker_ = std::move(maker);
    best = std::move(level);
    if (best->errorMax >= kCloseEnough * limit) break;
  }
  return best;
}

}  // namespace jalousie::bake
