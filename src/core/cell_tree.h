// Division of a mesh's triangles into spatial cells, the same for all levels of a chain.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie {

/// A k-d tree over the triangles of LOD 0. Its leaves are the cells. Coarser levels have fewer triangles for the same
/// leaves: leaves whose triangles fit into one cell together are merged for that level.
class CellTree {
 public:
  /// Halves the triangles at a plane across the longest side of their centroids' box, until no part has more than
  /// trianglesPerCell or its centroids coincide.
  /// @param centroids  of the triangles of LOD 0, finite   @param trianglesPerCell  at least 1
  CellTree(std::span<const glm::vec3> centroids, std::uint32_t trianglesPerCell);

  /// Number of cells, at least 1.
  std::uint32_t cellCount() const { return cellCount_; }
  /// The cell of each triangle of a level. Merged leaves share the number of the first one; the others stay empty.
  std::vector<std::uint32_t> assign(std::span<const glm::vec3> centroids) const;

 private:
  struct Node {
    float plane = 0.0F;
    int axis = -1;                ///< -1: a leaf
    std::uint32_t second = 0;     ///< node of the part at or beyond the plane; the other part's node is the next one
    std::uint32_t firstCell = 0;  ///< number of the first leaf below
  };

  class Builder;

  std::uint32_t trianglesPerCell_;
  std::uint32_t cellCount_ = 0;
  std::vector<Node> nodes_;  ///< depth first, the root first
};

/// In double precision, because the sum of three floats may be too large for a float. @param a, b, c  finite
glm::vec3 triangleCentroid(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Triangles in the order of their cells.
struct CellOrder {
  std::vector<std::uint32_t> triangles;  ///< their numbers: cell by cell, within a cell ascending
  std::vector<std::uint32_t> ends;       ///< behind each cell's triangles in `triangles`
};

/// @param cells  of each triangle, below cellCount
CellOrder orderByCell(std::span<const std::uint32_t> cells, std::uint32_t cellCount);

}  // namespace jalousie
