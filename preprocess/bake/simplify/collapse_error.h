// The error of merging vertices: quadrics per vertex, linear attribute functions per wedge.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/collapse_options.h"
#include "bake/simplify/quadric.h"

namespace jalousie::bake {

/// Wedges that meet when two vertices are merged, and which of them become one.
struct WedgeMerge {
  static constexpr std::size_t kMost = 64;
  std::array<std::uint32_t, kMost> wedges;
  std::array<std::uint8_t, kMost> group;  ///< of each wedge, below groups
  std::array<std::uint8_t, kMost> fromV;  ///< whether the wedge belongs to the second vertex
  std::size_t count = 0;
  std::size_t groups = 0;
};

/// Holds one quadric per vertex and, per wedge and weighted attribute, the area-weighted sum of the linear functions
/// g.p + d of the triangles that went into it. Positions are in the unit frame: centred, the box's diagonal is 1.
class CollapseError {
 public:
  CollapseError(const WedgeMesh& mesh, const EdgeTable& edges, const CollapseOptions& options,
                std::span<const glm::dvec3> unitPositions);

  /// Error of both vertices as a function of the position alone, with the attributes of least error.
  Quadric merged(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge) const;
  /// Attributes of each group at unit-frame position p. @param along  where p lies between u (0) and v (1), for
  /// attributes without weight @param values  [groups * stride], filled
  void attributesAt(const glm::dvec3& p, double along, const WedgeMerge& merge, std::vector<float>& values) const;
  /// Merges v into u, and the wedges of each group into its first wedge. @param values  from attributesAt
  void commit(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge, const std::vector<float>& values);

  const float* attributes(std::uint32_t wedge) const { return attributes_.data() + std::size_t{wedge} * stride_; }
  /// @param values  all floats of the wedge
  void setAttributes(std::uint32_t wedge, const float* values) {
    std::copy_n(values, stride_, attributes_.begin() + static_cast<std::ptrdiff_t>(std::size_t{wedge} * stride_));
  }
  bool weighsAttributes() const { return !weights_.empty(); }

 private:
  struct Weighted {
    std::uint32_t offset;  ///< among a wedge's floats
    double weight;
    bool bounded;  ///< kept near the values that are merged
  };
  struct Linear {
    glm::dvec3 g{0.0};
    double d = 0.0;
  };
  void addTriangles(const WedgeMesh& mesh, std::span<const glm::dvec3> positions);
  void addEdges(const WedgeMesh& mesh, const EdgeTable& edges, std::span<const glm::dvec3> positions);
  void chooseWeights(const WedgeMesh& mesh, const CollapseOptions& options, std::span<const glm::dvec3> positions);
  void sumGroup(const WedgeMerge& merge, std::size_t group, std::span<Linear> sums, double& area) const;

  std::uint32_t stride_;
  std::vector<float> attributes_;
  std::vector<Weighted> weights_;
  std::vector<Quadric> quadrics_;
  std::vector<Linear> linear_;  ///< [wedge * weights_.size() + k]
  std::vector<double> areas_;   ///< [wedge]
};

}  // namespace jalousie::bake
