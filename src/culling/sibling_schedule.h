// The visibility pipeline on queries: units of equal eye-siding over a loose grid.
#pragma once

#include <array>
#include <vector>

#include "culling/loose_grid.h"
#include "culling/query_schedule.h"

namespace jalousie::culling {

/// Visits units of nodes that cannot hide each other, from the eye outwards; the nodes of a unit ask together. Nodes
/// near the root are tested against the view's planes, those below by their query alone.
class SiblingSchedule : public QuerySchedule {
 public:
  /// @param grid  outlives the schedule
  explicit SiblingSchedule(const LooseGrid& grid) : QuerySchedule(grid.tree), grid_(grid) {}

 private:
  using Unit = std::vector<std::uint32_t>;
  /// The units below one unit, by eye-siding.
  using Level = std::array<Unit, 4>;

  void decide() override;
  void visit(const Unit& unit, std::uint32_t depth);
  void findVisible(const Unit& unit, std::uint32_t depth, Unit& visible);
  void askAll(const Unit& nodes, Unit& visible);

  const LooseGrid& grid_;
  std::vector<Level> levels_;  ///< [depth]
  std::vector<Unit> visible_;  ///< [depth]
  std::vector<Asked> asked_;
  Unit asking_;
};

}  // namespace jalousie::culling
