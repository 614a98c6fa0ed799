// Merges the cost curves of all meshes into one and cuts it at the levels.
#include "bake/simplify/scene_budget.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

/// The most triangles of a step, over those of the level before: two levels that hardly differ are one too many.
constexpr double kMostStep = 0.8;

std::size_t levelsOf(const ChainOptions& options) {
  return options.ratios.empty() ? options.levels : options.ratios.size() + 1;
}

/// All costs at which a mesh changes, ascending.
std::vector<double> allCosts(std::span<const BudgetMesh> meshes) {
  std::vector<double> costs;
  for (const BudgetMesh& mesh : meshes)
    for (const CostPoint& point : mesh.costs)
      costs.push_back(point.cost);
  for (const BudgetMesh& mesh : meshes)
    if (std::isfinite(mesh.removal)) costs.push_back(mesh.removal);
  std::sort(costs.begin(), costs.end());
  costs.erase(std::unique(costs.begin(), costs.end()), costs.end());
  return costs;
}

/// Triangles of a mesh after all its collapses up to a cost.
std::uint32_t trianglesAt(const BudgetMesh& mesh, double cost) {
  const auto end = std::upper_bound(mesh.costs.begin(), mesh.costs.end(), cost,
                                    [](double value, const CostPoint& point) { return value < point.cost; });
  return end == mesh.costs.begin() ? mesh.triangles : std::prev(end)->triangles;
}

/// Whether a mesh may be left out of a level: two steps would leave less than a triangle of it, or less than a level
/// where no collapse is left. @param last  its triangles in the level before
bool mayGo(const BudgetMesh& mesh, std::uint32_t last, double step) {
  const std::uint32_t fewest = mesh.costs.empty() ? mesh.triangles : mesh.costs.back().triangles;
  const double floor = step * step * last;
  return floor <= 1.0 || (floor <= kMinLevelTriangles && kMostStep * last <= fewest);
}

/// One level of all meshes.
struct Cut {
  std::vector<std::uint32_t> triangles;  ///< by mesh
  std::uint64_t total = 0;               ///< over all nodes
};

/// @param last  the level before   @param step  triangles of this level over those of the level before
Cut cutAt(std::span<const BudgetMesh> meshes, double cost, const Cut& last, double step) {
  Cut cut;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    // A program that chooses a level for each object needs levels between a fine and a coarse one: no mesh takes more
    // than two steps at once.
    const auto floor = static_cast<std::uint32_t>(std::ceil(step * step * last.triangles[m]));
    if (last.triangles[m] == 0 || (meshes[m].removal <= cost && mayGo(meshes[m], last.triangles[m], step))) {
      cut.triangles.push_back(0);
      continue;
    }
    const std::uint32_t least = std::max(std::min(floor, meshes[m].unseen), kMinLevelTriangles);
    const std::uint32_t wanted = std::max(trianglesAt(meshes[m], cost), least);
    cut.triangles.push_back(wanted > kMostStep * last.triangles[m] ? last.triangles[m] : wanted);
    cut.total += meshes[m].nodes * cut.triangles.back();
  }
  return cut;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shareBudget(std::span<const BudgetMesh> meshes, const ChainOptions& options) {
  std::vector<std::vector<std::uint32_t>> targets(meshes.size());
  const std::vector<double> costs = allCosts(meshes);
  Cut last;
  for (const BudgetMesh& mesh : meshes) {
    last.triangles.push_back(mesh.triangles);
    last.total += mesh.nodes * mesh.triangles;
  }
  const auto finest = static_cast<std::uint32_t>(std::min<std::uint64_t>(last.total, std::numeric_limits<int>::max()));
  std::uint32_t before = finest;
  for (std::size_t k = 1; k < levelsOf(options) && !costs.empty(); ++k) {
    const std::uint32_t wanted = targetOf(options, finest, k);
    const double step = static_cast<double>(wanted) / std::max(before, 1U);
    const auto enough = std::partition_point(costs.begin(), std::prev(costs.end()), [&](double cost) {
      return cutAt(meshes, cost, last, step).total > wanted;
    });
    const Cut cut = cutAt(meshes, *enough, last, step);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (cut.triangles[m] < last.triangles[m]) targets[m].push_back(cut.triangles[m]);
    last = cut;
    before = wanted;
  }
  return targets;
}

}  // namespace jalousie::bake
