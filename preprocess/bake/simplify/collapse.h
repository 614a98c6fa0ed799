// Edge collapse by quadrics over position and attributes, towards ever fewer triangles.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/collapse_options.h"

namespace jalousie::bake {

/// Collapses edges in the order of their error. A chain is made by asking for fewer triangles again and again.
/// The error of a position is the area-weighted squared distance to the planes of all triangles that were merged into
/// it (Garland and Heckbert 1997) plus, per wedge and attribute, the squared deviation from what those triangles'
/// linear attribute functions say there (Hoppe 1999); the attributes of least error follow in closed form, so one 3x3
/// system gives the new vertex. Open borders, edges between materials, texture seams and hard edges are held by planes
/// perpendicular to their triangles.
class EdgeCollapser {
 public:
  /// Keeps a reference to the mesh.
  EdgeCollapser(const WedgeMesh& mesh, const CollapseOptions& options);
  ~EdgeCollapser();
  EdgeCollapser(const EdgeCollapser&) = delete;
  EdgeCollapser& operator=(const EdgeCollapser&) = delete;

  /// Goes on until at most `target` triangles are left or no collapse is legal. Loose parts that are smaller than the
  /// error at hand go as a whole, never the largest one, and never below kMinLevelTriangles.
  void collapseTo(std::uint32_t target);
  std::uint32_t triangles() const;
  /// The mesh as it is now.
  WedgeMesh mesh() const;

  static constexpr std::uint32_t kGone = ~0U;
  /// For each vertex of the source: the vertex of mesh() that it became, or kGone.
  std::vector<std::uint32_t> vertexMap() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace jalousie::bake
