// One collapse makes all levels; only its locks change from step to step.
#include "bake/simplify/cell_levels.h"

#include <algorithm>
#include <utility>

#include "bake/mesh/flat_shading.h"
#include "bake/simplify/cell_groups.h"
#include "bake/simplify/level_maker.h"
#include "bake/simplify/refit.h"
#include "core/check.h"

namespace jalousie::bake {

/// What one step knows.
struct CellLevelMaker::Step {
  std::vector<std::uint32_t> groupOfCell;
  std::uint32_t groups = 0;
  std::vector<std::uint32_t> before;       ///< triangles of the finest mesh that the last level still has
  std::vector<std::uint32_t> groupBefore;  ///< of each of these
  std::vector<std::uint8_t> lockedFinest;  ///< for each vertex of the finest mesh 1 if it became a locked one
  std::vector<std::uint32_t> groupAfter;   ///< of each triangle of the new level
};

namespace {

/// Which of the finest mesh's vertices are now a vertex that is locked.
std::vector<std::uint8_t> lockedOf(const std::vector<std::uint32_t>& vertexMap,
                                   const std::vector<std::uint8_t>& between) {
  std::vector<std::uint8_t> locked(vertexMap.size(), 0);
  for (std::size_t v = 0; v < vertexMap.size(); ++v)
    locked[v] = vertexMap[v] != EdgeCollapser::kGone ? between[vertexMap[v]] : 0;
  return locked;
}

/// The groups of those triangles that a step left over. @param before, after  triangles of the finest mesh, ascending
std::vector<std::uint32_t> groupsLeft(const std::vector<std::uint32_t>& before,
                                      const std::vector<std::uint32_t>& groups,
                                      const std::vector<std::uint32_t>& after) {
  std::vector<std::uint32_t> left;
  left.reserve(after.size());
  std::size_t at = 0;
  for (const std::uint32_t triangle : after) {
    while (before[at] != triangle)
      ++at;
    left.push_back(groups[at]);
  }
  return left;
}

}  // namespace

CellLevelMaker::CellLevelMaker(const WedgeMesh& mesh, const ChainOptions& options)
    : finest_(mesh),
      options_(options),
      flat_(flatPrimitives(mesh)),
      collapser_(mesh, collapseOptions(options, flat_)),
      current_(collapser_.mesh()) {
  JAL_CHECK(options.cellTriangles > 0U);
  JAL_CHECK((options.preset != Preset::kDraft));
}

CellDivision CellLevelMaker::finest() const {
  CellDivision division;
  const std::vector<std::uint32_t> oneGroup(finest_.triangles(), 0);
  division.cellOf = divideGroups(finest_, oneGroup, options_.cellTriangles, division.producerOf);
  division.cells = static_cast<std::uint32_t>(division.producerOf.size());
  division.producerOf.clear();
  return division;
}

ChainLevel CellLevelMaker::next(std::uint32_t target, const DeviationMeter& meter, ChainLevel& last) {
  JAL_CHECK(last.cells.has_value());
  const CellDivision& cells = *last.cells;
  Step step;
  step.groupOfCell = groupCells(current_, {cells.cellOf, cells.producerOf, cells.cells}, options_.cellTriangles);
  step.groups = *std::max_element(step.groupOfCell.begin(), step.groupOfCell.end()) + 1;
  step.before = collapser_.sourceTriangles();
  for (const std::uint32_t cell : cells.cellOf)
    step.groupBefore.push_back(step.groupOfCell[cell]);
  const std::vector<std::uint8_t> between = verticesBetween(current_, step.groupBefore);
  step.lockedFinest = lockedOf(collapser_.vertexMap(), between);
  collapser_.continueFrom(current_, between);
  collapser_.collapseTo(target);

  ChainLevel level;
  level.mesh = collapser_.mesh();
  level.removedParts = collapser_.removedParts();
  if (level.mesh.triangles() < kMinLevelTriangles) return level;
  const std::vector<std::uint32_t> vertexMap = collapser_.vertexMap();
  step.groupAfter = groupsLeft(step.before, step.groupBefore, collapser_.sourceTriangles());
  refit(step, vertexMap, level.mesh);
  current_ = level.mesh;
  restoreFlatShading(flat_, level.mesh);
  divide(step, level);
  measure(step, meter, vertexMap, level, last);
  return level;
}

/// As LevelMaker::refit. Locked vertices keep position and attributes, and parts that have some do not grow.
void CellLevelMaker::refit(const Step& step, const std::vector<std::uint32_t>& vertexMap, WedgeMesh& level) const {
  const PartClasses& classes = collapser_.partClasses();
  RefitOptions options = refitOptions(options_, classes);
  std::vector<std::uint8_t> locked = step.lockedFinest;
  for (std::size_t v = 0; v < options.locked.size(); ++v)
    locked[v] = locked[v] | options.locked[v];
  options.locked = locked;
  refitLevel(finest_, vertexMap, options, level);
  if (options_.collapse.lockBorder) return;
  const std::vector<glm::vec3> fitted = level.positions;
  growParts(classes, vertexMap, level);
  std::vector<std::uint8_t> stays(classes.classOf.size(), 0);
  for (std::size_t v = 0; v < locked.size(); ++v)
    if (locked[v] != 0) stays[classes.partOfVertex[v]] = 1;
  for (std::size_t v = 0; v < locked.size(); ++v)
    if (vertexMap[v] != EdgeCollapser::kGone && stays[classes.partOfVertex[v]] != 0)
      level.positions[vertexMap[v]] = fitted[vertexMap[v]];
}

void CellLevelMaker::divide(const Step& step, ChainLevel& level) const {
  CellDivision& cells = level.cells.emplace();
  cells.cellOf = divideGroups(level.mesh, step.groupAfter, options_.cellTriangles, cells.producerOf);
  cells.cells = static_cast<std::uint32_t>(cells.producerOf.size());
}

void CellLevelMaker::measure(const Step& step, const DeviationMeter& meter, const std::vector<std::uint32_t>& vertexMap,
                             ChainLevel& level, ChainLevel& last) {
  // What became of a group that is gone is missed where it was.
  std::vector<std::uint8_t> isLeft(step.groups, 0);
  for (const std::uint32_t group : step.groupAfter)
    isLeft[group] = 1;
  std::vector<std::uint32_t> lost(finest_.triangles(), ~0U);
  for (std::size_t i = 0; i < step.before.size(); ++i)
    if (isLeft[step.groupBefore[i]] == 0) lost[step.before[i]] = step.groupBefore[i];

  std::vector<Distances> errors;
  level.deviation = meter.measure(level.mesh, vertexMap, {step.groups, step.groupAfter, lost}, errors);
  level.errorMax = std::max(level.deviation.twoSided.max, last.errorMax);
  CellDivision& cells = *last.cells;
  if (!errors_.empty()) {
    for (std::uint32_t cell = 0; cell < cells.cells; ++cell) {
      const Distances& finer = errors_[cells.producerOf[cell]];
      Distances& coarser = errors[step.groupOfCell[cell]];
      coarser = {std::max(coarser.max, finer.max), std::max(coarser.mean, finer.mean)};
    }
  }
  cells.groupOf = step.groupOfCell;
  cells.errors = errors;
  errors_ = std::move(errors);
}

}  // namespace jalousie::bake
