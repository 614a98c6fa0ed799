// Divides the triangles of a scene's levels among its meshes.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bake/simplify/chain_options.h"
#include "bake/simplify/collapse.h"

namespace jalousie::bake {

/// What a mesh offers to a budget.
struct BudgetMesh {
  std::uint32_t triangles = 0;   ///< of LOD 0
  std::uint64_t nodes = 1;       ///< that show it, instances of each counted
  std::vector<CostPoint> costs;  ///< squared distances times areas, world units; ascending
  double diagonal = 0.0;         ///< of its box, world units
  std::uint32_t unseen = ~0U;    ///< see CostCurve::unseen
  /// What it costs to leave the whole mesh out, for each two triangles that this saves at last; in the unit of costs.
  double removal = std::numeric_limits<double>::infinity();
};

/// For each mesh its targets, as ChainOptions::targets: at level k, all collapses up to one common cost are made in
/// every mesh, so that the scene has at most as many triangles as the options ask for. That is the order in which one
/// queue over all meshes would make them. But no mesh takes more than two steps at once, unless nobody sees the
/// difference: where the scene has a share r of the triangles of the level before, a mesh keeps at least r^2. It is
/// left out (a target of 0) only where r^2 of it would be less than a triangle, or where it can collapse no further. A
/// level that would have more than four fifths of the triangles of the one before is left out of the targets of the
/// mesh. A mesh that never changes has none.
std::vector<std::vector<std::uint32_t>> shareBudget(std::span<const BudgetMesh> meshes, const ChainOptions& options);

}  // namespace jalousie::bake
