// Centroids of all primitives together, and a counting sort by cell.
#include "bake/io/level_cells.h"

#include <algorithm>
#include <numeric>

namespace jalousie::bake {
namespace {

/// In double precision, because the sum of three floats may be too large for a float.
std::vector<glm::vec3> centroids(const CombinedMesh& mesh) {
  std::vector<glm::vec3> result;
  result.reserve(mesh.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::dvec3 sum = glm::dvec3(mesh.positions[mesh.indices[i]]) +
                           glm::dvec3(mesh.positions[mesh.indices[i + 1]]) +
                           glm::dvec3(mesh.positions[mesh.indices[i + 2]]);
    result.emplace_back(sum / 3.0);
  }
  return result;
}

}  // namespace

std::optional<asset::CellTree> divideIntoCells(const CombinedMesh& finest, const CellOptions& options) {
  if (options.trianglesPerCell == 0) return std::nullopt;
  const auto primitives = static_cast<std::uint32_t>(finest.primitives.size());
  const std::uint32_t perCell = std::max(options.trianglesPerCell, kLeastPerPrimitive * primitives);
  const std::uint64_t undivided = std::uint64_t{perCell} * (options.onlyLarge ? 2 : 1);
  if (finest.indices.size() / 3 <= undivided) return std::nullopt;
  asset::CellTree tree(centroids(finest), perCell);
  if (tree.cellCount() == 1) return std::nullopt;
  return tree;
}

CellOrder orderByCells(const CombinedMesh& level, const std::optional<asset::CellTree>& tree) {
  CellOrder order;
  order.triangles.resize(level.indices.size() / 3);
  if (!tree) {
    std::iota(order.triangles.begin(), order.triangles.end(), 0U);
    order.ends = {static_cast<std::uint32_t>(order.triangles.size())};
    return order;
  }
  const std::vector<std::uint32_t> cells = tree->assign(centroids(level));
  std::vector<std::uint32_t> next(tree->cellCount(), 0);  // per cell the place of its next triangle
  for (const std::uint32_t cell : cells)
    ++next[cell];
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
  for (std::uint32_t triangle = 0; triangle < cells.size(); ++triangle)
    order.triangles[next[cells[triangle]]++] = triangle;
  order.ends = std::move(next);
  return order;
}

}  // namespace jalousie::bake
