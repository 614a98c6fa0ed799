// Distance from points to a triangle mesh, through a bounding volume hierarchy.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Squared distance from p to triangle abc (Ericson 2005, 5.1.5), degenerate triangles included.
double squaredDistanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Binary hierarchy over triangles, split at the median of the widest axis. Build O(n log^2 n), deterministic.
class TriangleBvh {
 public:
  /// Keeps copies. @pre indices in threes, in range, at least one triangle (checked)
  TriangleBvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

  /// Distance to the nearest point of the mesh, object-space length. Safe to call from several threads.
  double distance(const glm::vec3& point) const;

 private:
  struct Node {
    glm::vec3 min, max;
    std::uint32_t first = 0;  ///< first triangle of a leaf, or the right child
    std::uint32_t count = 0;  ///< triangles of a leaf; 0 for inner nodes, whose left child follows directly
  };
  struct Corners {
    glm::vec3 a, b, c;
  };
  void build(std::span<std::uint32_t> order, std::uint32_t first, std::span<const Corners> source);

  std::vector<Node> nodes_;
  std::vector<Corners> triangles_;
};

}  // namespace jalousie::bake
