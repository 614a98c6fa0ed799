// Merges the cost curves of all meshes into one and cuts it at the levels.
#include "bake/simplify/scene_budget.h"

#include <algorithm>
#include <limits>

#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

/// A step of one mesh's curve.
struct Step {
  double cost;
  std::uint32_t mesh;
  std::uint32_t triangles;  ///< of the mesh after it
};

std::vector<Step> mergedSteps(std::span<const BudgetMesh> meshes) {
  std::vector<Step> steps;
  for (std::uint32_t m = 0; m < meshes.size(); ++m)
    for (const CostPoint& point : meshes[m].costs)
      steps.push_back({point.cost, m, point.triangles});
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.mesh != b.mesh ? a.mesh < b.mesh : a.triangles > b.triangles;
  });
  return steps;
}

std::size_t levelsOf(const ChainOptions& options) {
  return options.ratios.empty() ? options.levels : options.ratios.size() + 1;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shareBudget(std::span<const BudgetMesh> meshes, const ChainOptions& options) {
  std::vector<std::vector<std::uint32_t>> targets(meshes.size());
  std::vector<std::uint32_t> now;
  std::uint64_t total = 0;
  for (const BudgetMesh& mesh : meshes) {
    now.push_back(mesh.triangles);
    total += mesh.nodes * mesh.triangles;
  }
  const auto finest = static_cast<std::uint32_t>(std::min<std::uint64_t>(total, std::numeric_limits<int>::max()));
  const std::vector<Step> steps = mergedSteps(meshes);
  std::size_t next = 0;
  for (std::size_t k = 1; k < levelsOf(options); ++k) {
    const std::uint32_t wanted = targetOf(options, finest, k);
    while (next < steps.size() && total > wanted) {
      const Step& step = steps[next++];
      total -= meshes[step.mesh].nodes * (now[step.mesh] - std::min(now[step.mesh], step.triangles));
      now[step.mesh] = std::min(now[step.mesh], step.triangles);
    }
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::uint32_t last = targets[m].empty() ? meshes[m].triangles : targets[m].back();
      const std::uint32_t target = std::max(now[m], kMinLevelTriangles);
      if (target < last) targets[m].push_back(target);
    }
  }
  return targets;
}

}  // namespace jalousie::bake
