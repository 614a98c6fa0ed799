// Divides the triangles of a scene's levels among its meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/simplify/chain_options.h"
#include "bake/simplify/collapse.h"

namespace jalousie::bake {

/// What a mesh offers to a budget.
struct BudgetMesh {
  std::uint32_t triangles = 0;   ///< of LOD 0
  std::uint64_t nodes = 1;       ///< that show it
  std::vector<CostPoint> costs;  ///< squared distances in world units; ascending
  double diagonal = 0.0;         ///< of its box, world units
};

/// For each mesh its targets, as ChainOptions::targets: at level k, all collapses up to one common cost are made in
/// every mesh, so that the scene has at most as many triangles as the options ask for. Levels that change nothing in a
/// mesh are left out of its targets; a mesh that never changes has none.
std::vector<std::vector<std::uint32_t>> shareBudget(std::span<const BudgetMesh> meshes, const ChainOptions& options);

}  // namespace jalousie::bake
