// Makes the levels of a chain whose cells can have levels of their own (docs/lod_chain.md, "A level per cell").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/chain_level.h"
#include "bake/simplify/chain_options.h"
#include "bake/simplify/collapse.h"
#include "bake/simplify/measure.h"

namespace jalousie::bake {

/// Makes one level after the other. A step puts the cells of the last level into groups, locks the vertices between
/// groups, collapses and refits the rest, and divides what becomes of each group into cells. Triangles inside a group
/// change, its outer border does not: a collapse maps the border onto itself. So every group can be drawn before or
/// after the step beside all others, without a crack.
class CellLevelMaker {
 public:
  /// Keeps references. @param options  cellTriangles is not 0, preset is not kDraft (checked)
  CellLevelMaker(const WedgeMesh& mesh, const ChainOptions& options);

  /// The cells of LOD 0.
  CellDivision finest() const;
  /// Makes and measures the next level. It gets neither deviation nor cells if it has fewer than kMinLevelTriangles.
  /// @param last  the level made before, or LOD 0; its cells get groups and their errors
  ChainLevel next(std::uint32_t target, const DeviationMeter& meter, ChainLevel& last);

 private:
  struct Step;
  void refit(const Step& step, const std::vector<std::uint32_t>& vertexMap, WedgeMesh& level) const;
  void divide(const Step& step, ChainLevel& level) const;
  void measure(const Step& step, const DeviationMeter& meter, const std::vector<std::uint32_t>& vertexMap,
               ChainLevel& level, ChainLevel& last);

  const WedgeMesh& finest_;
  const ChainOptions& options_;
  std::vector<bool> flat_;  ///< primitives
  EdgeCollapser collapser_;
  std::vector<Distances> errors_;  ///< of the groups of the last step
  WedgeMesh current_;              ///< the last level before its flat primitives were made flat
};

}  // namespace jalousie::bake
