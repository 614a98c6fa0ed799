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

std::uint32_t cellTriangles(const CombinedMesh& finest, const CellOptions& options) {
  if (options.trianglesPerCell == 0) return 0;
  const auto primitives = static_cast<std::uint32_t>(finest.primitives.size());
  const std::uint32_t perCell = std::max(options.trianglesPerCell, kLeastPerPrimitive * primitives);
  const std::uint64_t undivided = std::uint64_t{perCell} * (options.onlyLarge ? 2 : 1);
  return finest.indices.size() / 3 <= undivided ? 0 : perCell;
}

std::optional<CellTree> divideIntoCells(const CombinedMesh& finest, const CellOptions& options) {
  const std::uint32_t perCell = cellTriangles(finest, options);
  if (perCell == 0) return std::nullopt;
  CellTree tree(centroids(finest), perCell);
  if (tree.cellCount() == 1) return std::nullopt;
  return tree;
}

CellOrder orderByCells(const CombinedMesh& level, const std::optional<CellTree>& tree) {
  if (!tree) return orderByCell(std::vector<std::uint32_t>(level.indices.size() / 3, 0), 1);
  return orderByCell(tree->assign(centroids(level)), tree->cellCount());
}

CellOrder orderByCells(const LevelChain& chain, std::size_t k) {
  std::uint32_t most = 0;  // all levels of a chain have equally many
  for (const ChainLevel& level : chain.levels)
    most = std::max(most, level.cells->cells);
  return orderByCell(chain.levels[k].cells->cellOf, most);
}

asset::LodCellLevels cellLevelsOf(const LevelChain& chain, std::size_t k) {
  const CellDivision& cells = *chain.levels[k].cells;
  asset::LodCellLevels levels;
  if (k > 0) levels.producedCells.resize(chain.levels[k - 1].cells->errors.size(), 0);
  for (const std::uint32_t producer : cells.producerOf)
    ++levels.producedCells[producer];
  levels.groupOf = cells.groupOf;
  for (const Distances& error : cells.errors)
    levels.errors.push_back({error.max, error.mean});
  return levels;
}

}  // namespace jalousie::bake
