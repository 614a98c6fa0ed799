// Edge collapse with quadrics over position and attributes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/collapse_options.h"
#include "bake/simplify/part_classes.h"

namespace jalousie::bake {

/// A point of the curve of cost over triangles.
struct CostPoint {
  std::uint32_t triangles = 0;
  double cost = 0.0;
};

/// Collapses edges in the order of their error. To make a chain, call collapseTo with descending targets.
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
  /// A copy continues where the other one is.
  EdgeCollapser(const EdgeCollapser& other);
  EdgeCollapser& operator=(const EdgeCollapser&) = delete;

  /// Collapses until at most `target` triangles are left or no collapse is legal. A loose part that is smaller than the
  /// current error is removed as a whole, except the largest part, and never below kMinLevelTriangles. The costs and
  /// the order of removals are those of part_classes.h. If nothing legal is left above the target, edges are collapsed
  /// and parts removed without regard to the topology and to a count somewhat below the target.
  void collapseTo(std::uint32_t target);
  /// From now on, these loose parts are not removed as a whole. @param keep  for each part 1 or 0; empty: none
  void keepParts(std::span<const std::uint8_t> keep);
  /// From now on, the current mesh has the positions and attributes of a level, and other vertices are locked: they and
  /// their attributes stay, no loose part with one of them is removed, and while there are any, the topology is never
  /// changed. The locks of the options stay as well.
  /// @param level  what mesh() returned last, moved since   @param lockedVertices  of the level: 1 for locked
  void continueFrom(const WedgeMesh& level, std::span<const std::uint8_t> lockedVertices);
  std::uint32_t triangles() const;
  /// The current mesh.
  WedgeMesh mesh() const;
  /// For each triangle of mesh() the one of the source that it was, ascending.
  std::vector<std::uint32_t> sourceTriangles() const;

  /// What was collapsed so far: triangles that were left when no collapse or removal of a lower cost was. The costs
  /// ascend; they are squared distances times areas, in the unit frame.
  const std::vector<CostPoint>& costs() const;

  static constexpr std::uint32_t kGone = ~0U;
  /// For each vertex of the source: the vertex of mesh() that it became, or kGone.
  std::vector<std::uint32_t> vertexMap() const;
  const PartClasses& partClasses() const;
  /// Loose parts that were removed as a whole so far.
  std::uint32_t removedParts() const;

 private:
  struct Data;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace jalousie::bake
