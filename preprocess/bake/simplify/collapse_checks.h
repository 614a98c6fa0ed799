// Checks of a collapse: which wedges it merges, and whether the triangles around it keep their orientation.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/collapse_error.h"
#include "bake/simplify/collapse_topology.h"

namespace jalousie::bake {

/// Checks collapses of a mesh. Changes nothing but the topology's lists, from which it removes dead corners.
class CollapseChecks {
 public:
  /// Keeps references. @param positions  of vertices, as they move
  CollapseChecks(const WedgeMesh& source, const std::vector<glm::dvec3>& positions, const CollapseError& error,
                 CollapseTopology& topology);

  /// Finds the wedges at u and v and joins those that a shared triangle will bring together, which are therefore of one
  /// primitive. False if wedges would have to be joined that cannot be one (tangents of opposite handedness), or if
  /// there are too many.
  /// @param singleWedge  per vertex its wedge if it has just one
  bool gather(std::uint32_t u, std::uint32_t v, std::span<const std::uint32_t> singleWedge, WedgeMerge& merge);
  /// No triangle that stays may turn by more than about 75 degrees or lose its area when u and v move to p.
  bool keepsFacing(std::uint32_t u, std::uint32_t v, const glm::dvec3& p);
  /// No triangle that stays may turn over in texture space. @param values  new attributes of each group of the merge
  bool keepsTexture(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge, const std::vector<float>& values);

 private:
  bool canJoin(std::uint32_t a, std::uint32_t b) const;
  /// Calls visit(corner, a, b) for the corners at `moved` whose triangles do not touch `other`; a, b are the others.
  template <class Visit>
  void forEachStaying(std::uint32_t moved, std::uint32_t other, const Visit& visit);

  const WedgeMesh& source_;
  const std::vector<glm::dvec3>& positions_;
  const CollapseError& error_;
  CollapseTopology& topology_;
  std::optional<std::uint32_t> signOffset_;  ///< of the tangents' handedness
  std::vector<std::uint32_t> uvOffsets_;
};

}  // namespace jalousie::bake
