// Centroids of all primitives together.
#include "bake/io/level_cells.h"

#include <algorithm>

namespace jalousie::bake {
namespace {

std::vector<glm::vec3> centroids(const CombinedMesh& mesh) {
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[i]]; };
  std::vector<glm::vec3> result;
  result.reserve(mesh.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    result.push_back(triangleCentroid(corner(i), corner(i + 1), corner(i + 2)));
  return result;
}

}  // namespace

std::optional<CellTree> divideIntoCells(const CombinedMesh& finest, const CellOptions& options) {
  if (options.trianglesPerCell == 0) return std::nullopt;
  const auto primitives = static_cast<std::uint32_t>(finest.primitives.size());
  const std::uint32_t perCell = std::max(options.trianglesPerCell, kLeastPerPrimitive * primitives);
  const std::uint64_t undivided = std::uint64_t{perCell} * (options.onlyLarge ? 2 : 1);
  if (finest.indices.size() / 3 <= undivided) return std::nullopt;
  CellTree tree(centroids(finest), perCell);
  if (tree.cellCount() == 1) return std::nullopt;
  return tree;
}

CellOrder orderByCells(const CombinedMesh& level, const std::optional<CellTree>& tree) {
  if (!tree) return orderByCell(std::vector<std::uint32_t>(level.indices.size() / 3, 0), 1);
  return orderByCell(tree->assign(centroids(level)), tree->cellCount());
}

}  // namespace jalousie::bake
