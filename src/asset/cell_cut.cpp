// A legal cut is monotone: flags of a group imply those of the groups below it.
#include "asset/cell_cut.h"

#include <utility>

namespace jalousie::asset {

CellHierarchy::CellHierarchy(std::vector<LodCellLevels> levels) : levels_(std::move(levels)) {
  for (const LodCellLevels& level : levels_) {
    cellsOf_.push_back(filledCells(level));
    std::vector<std::uint32_t>& producers = producers_.emplace_back();
    for (std::uint32_t group = 0; group < level.producedCells.size(); ++group)
      producers.insert(producers.end(), level.producedCells[group], group);
  }
}

CellCut CellHierarchy::uniform(std::size_t level) const {
  CellCut cut;
  for (std::size_t k = 0; k + 1 < levels_.size(); ++k)
    cut.emplace_back(groups(k), static_cast<std::uint8_t>(k < level ? 1 : 0));
  return cut;
}

bool CellHierarchy::isLegal(const CellCut& cut) const {
  for (std::size_t k = 1; k + 1 < levels_.size(); ++k)
    for (std::uint32_t cell = 0; cell < cells(k); ++cell)
      if (cut[k][groupOf(k, cell)] != 0 && cut[k - 1][producerOf(k, cell)] == 0) return false;
  return true;
}

void CellHierarchy::makeLegal(CellCut& cut) const {
  for (std::size_t k = 1; k + 1 < levels_.size(); ++k)
    for (std::uint32_t cell = 0; cell < cells(k); ++cell)
      if (cut[k - 1][producerOf(k, cell)] == 0) cut[k][groupOf(k, cell)] = 0;
}

bool CellHierarchy::isDrawn(const CellCut& cut, std::size_t level, std::uint32_t cell) const {
  const bool isReached = level == 0 || cut[level - 1][producerOf(level, cell)] != 0;
  const bool isLeft = level + 1 < levels_.size() && cut[level][groupOf(level, cell)] != 0;
  return isReached && !isLeft;
}

std::vector<std::vector<Aabb>> groupBoxes(const CellHierarchy& hierarchy,
                                          const std::vector<std::vector<Aabb>>& cellBoxes) {
  std::vector<std::vector<Aabb>> boxes;
  for (std::size_t k = 0; k + 1 < hierarchy.levels(); ++k) {
    std::vector<Aabb> own(hierarchy.groups(k));
    for (std::uint32_t cell = 0; cell < hierarchy.cells(k); ++cell) {
      Aabb& box = own[hierarchy.groupOf(k, cell)];
      box.add(cellBoxes[k][cell]);
      if (k > 0) box.add(boxes[k - 1][hierarchy.producerOf(k, cell)]);
    }
    boxes.push_back(std::move(own));
  }
  return boxes;
}

namespace {

/// Makes each group coarse whose deviation is at most limit(level, group).
template <class Limit>
CellCut cutWithin(const CellHierarchy& hierarchy, CutBy by, const Limit& limit) {
  CellCut cut = hierarchy.uniform(0);
  for (std::size_t k = 0; k < cut.size(); ++k) {
    for (std::uint32_t group = 0; group < cut[k].size(); ++group) {
      const DistanceInfo& error = hierarchy.error(k, group);
      cut[k][group] = (by == CutBy::kMean ? error.mean : error.max) <= limit(k, group) ? 1 : 0;
    }
  }
  return cut;
}

}  // namespace

CellCut cutForEye(const CellHierarchy& hierarchy, const std::vector<std::vector<Aabb>>& boxes, const glm::dvec3& eye,
                  double slope, CutBy by) {
  return cutWithin(hierarchy, by,
                   [&](std::size_t k, std::uint32_t group) { return slope * distanceToBox(eye, boxes[k][group]); });
}

CellCut cutForError(const CellHierarchy& hierarchy, double error, CutBy by) {
  return cutWithin(hierarchy, by, [&](std::size_t, std::uint32_t) { return error; });
}

double distanceToBox(const glm::dvec3& point, const Aabb& box) {
  const glm::dvec3 nearest = glm::clamp(point, glm::dvec3(box.min), glm::dvec3(box.max));
  return glm::length(point - nearest);
}

}  // namespace jalousie::asset
