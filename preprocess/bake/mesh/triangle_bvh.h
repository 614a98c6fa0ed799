// Finds nearest points on a triangle mesh with a bounding volume hierarchy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace jalousie::bake {

/// A point of a triangle mesh, as seen from a query point.
struct NearestPoint {
  double distance2 = std::numeric_limits<double>::infinity();  ///< squared, object-space length
  std::uint32_t triangle = ~0U;
  glm::dvec3 barycentric{0.0};  ///< weights of the triangle's corners
};

/// The point of triangle abc nearest to p (Ericson 2005, 5.1.5), degenerate triangles included; `triangle` is not set.
NearestPoint nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Squared distance from p to triangle abc.
double squaredDistanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Hierarchy with four children per node over packets of four triangles. Vector instructions test four boxes or four
/// triangles at once. Nodes are split at the median of the widest axis. Build O(n log n), deterministic. The hierarchy
/// is scaled by a power of two to about unit size, so that squares neither overflow nor vanish at any scale.
class TriangleBvh {
 public:
  static constexpr std::uint32_t kNoSeed = ~0U;

  /// Keeps copies. @pre indices in threes, in range, at least one triangle (checked)
  TriangleBvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

  /// Nearest point of the mesh. Candidates are compared in single precision, relative to the point; the result is
  /// computed in double. Safe to call from several threads.
  /// @param seed  a triangle that is probably near: the search starts with its distance
  NearestPoint nearest(const glm::vec3& point, std::uint32_t seed = kNoSeed) const;
  /// Nearest point among the triangles that a test accepts; distance2 is infinite if none is nearer than `most`.
  /// @param most  distance, object-space length; a small one makes the search short
  NearestPoint nearestWhere(const glm::vec3& point, double most,
                            const std::function<bool(std::uint32_t)>& accepts) const;
  /// Distance to the nearest point of the mesh, object-space length.
  double distance(const glm::vec3& point, std::uint32_t seed = kNoSeed) const;
  /// Corners of triangle t.
  struct Corners {
    glm::vec3 a, b, c;
  };
  const Corners& corners(std::uint32_t t) const { return triangles_[t]; }

 private:
  using Float4 [[gnu::vector_size(16)]] = float;
  struct Vec4 {
    Float4 x, y, z;
  };
  /// Boxes of four children; an empty one is infinitely far.
  struct Node {
    Vec4 min, max;
    std::uint32_t child[4];  ///< node, or packet with kLeaf set
  };
  /// Four triangles; the last one is repeated to fill it.
  struct Packet {
    Vec4 a, b, c;
    std::uint32_t id[4];
  };
  struct Item {
    glm::vec3 center;
    std::uint32_t triangle = 0;
  };
  struct Box {
    glm::vec3 min, max;
  };
  static constexpr std::uint32_t kLeaf = 1U << 31U;
  /// State of one search: the best triangle so far and the nodes that wait.
  struct Search {
    struct Entry {
      std::uint32_t node;
      float distance2;
    };
    std::array<Entry, 96> stack;  ///< at most three siblings wait on each of log4(2^31) levels
    std::size_t size = 0;
    float best = std::numeric_limits<float>::infinity();  ///< squared distance
    std::uint32_t triangle = kNoSeed;
  };

  std::uint32_t build(std::span<Item> items, Box& box);
  static std::size_t split(std::span<Item> items);
  std::uint32_t makePacket(std::span<const Item> items, Box& box);
  static Float4 packetDistances(const Packet& packet, const glm::vec3& p);
  template <class Accepts>
  static void searchPacket(const Packet& packet, const glm::vec3& point, const Accepts& accepts, Search& search);
  template <class Accepts>
  void search(const glm::vec3& point, const Accepts& accepts, Search& search) const;
  /// Pushes the children of a node that may hold a nearer triangle, the nearest last.
  static void pushChildren(const Node& node, const Vec4& point, Search& search);

  std::uint32_t root_ = 0;
  float scale_ = 1.0F;  ///< of the hierarchy, relative to the triangles; a power of two
  std::vector<Node> nodes_;
  std::vector<Packet> packets_;
  std::vector<Corners> triangles_;
};

}  // namespace jalousie::bake
