// Groups of triangles of similar facing: the culling volume of a group, and the order that puts groups side by side
// (S. Kumar, D. Manocha, W. Garrett, M. Lin: Hierarchical Back-Face Computation, 1996; H. Zhang, K. Hoff: Fast Backface
// Culling Using Normal Masks, 1997).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"

namespace jalousie::asset {

/// How the triangles of a primitive are grouped: trees of two parts a node, in preorder. 0: a node, whose two parts
/// follow; another number: a group of so many triangles, which lie behind those of the groups before.
using FaceTree = std::vector<std::uint32_t>;

/// What groups are made by.
enum class FaceGrouping : std::uint32_t {
  kOff,
  kMasks,     ///< a group is one cell of the normals
  kClusters,  ///< groups and trees by expected time
  kMeshlets,  ///< meshoptimizer's meshlets, which follow connectivity
};

inline constexpr FaceGrouping kFaceGroupings[] = {FaceGrouping::kOff, FaceGrouping::kMasks, FaceGrouping::kClusters,
                                                  FaceGrouping::kMeshlets};

using Triangle = std::array<glm::vec3, 3>;

/// A triangle as the tests see it.
struct Facet {
  glm::dvec3 normal{0.0};  ///< unit; 0 for a triangle without area
  glm::dvec3 corner{0.0};
  double inradius = 0.0;  ///< of its inscribed circle
};

Facet facetOf(const Triangle& triangle);

/// A homogeneous eye: a point (w = 1), or against the direction of view (w = 0).
using Eye = glm::dvec4;

/// Bounds of the planes of triangles. With n and p of a triangle and the eye C it is a back face iff n.(p - C) > 0.
struct CullingVolume {
  glm::dvec3 lowest{0.0};   ///< componentwise least normal
  glm::dvec3 highest{0.0};  ///< and largest
  glm::dvec3 origin{0.0};   ///< c
  double least = 0.0;       ///< d = min n.(p - c)
  double most = 0.0;        ///< D = max n.(p - c)

  /// g(x) = max n.x over the box of normals.
  double support(const glm::dvec3& x) const;
  /// Lower bound of n.(p - C) over all triangles: d - g(C - c). Positive: all are back faces.
  double slack(const Eye& eye) const;
  /// Whether all are front faces: -g(c - C) > D.
  bool isFront(const Eye& eye) const;
};

/// Volume of triangles about the corner or the middle of their box that gives the largest d. The origin has the digits
/// of a float. @param bounds  of their corners   @pre not empty
CullingVolume volumeOf(std::span<const Facet> facets, const Aabb& bounds);
/// Volume of the triangles of two groups about a point: d = min over both of d_k - g_k(c - c_k).
CullingVolume unite(const CullingVolume& a, const CullingVolume& b, const glm::vec3& origin);

/// Cell of a normal on the cube: side, column and row.
struct NormalCell {
  std::uint32_t side = 0;  ///< 2 * axis + (negative)
  std::uint32_t column = 0;
  std::uint32_t row = 0;

  /// Row after row, every other one backwards: neighbours in the order are neighbours on the cube.
  std::uint32_t number() const;
};

/// @param normal  not 0
NormalCell normalCell(const glm::dvec3& normal);

/// Triangles in the order of their groups.
struct FaceOrder {
  std::vector<std::uint32_t> triangles;  ///< their numbers; within a group ascending
  FaceTree tree;
};

/// Cost of a test and a command, in triangles that are drawn.
inline constexpr double kFaceTestCost = 2.0;

/// Groups triangles. Thin triangles, whose facing the rasteriser may change, are in a group of their own at the end.
/// @param bounds  of the object: clusters expect the eye within three times its size
/// @param grouping  not kOff   @return  no tree without triangles
FaceOrder groupFaces(std::span<const Triangle> triangles, const Aabb& bounds, FaceGrouping grouping);

/// Triangles of all groups of a tree. nullopt: it is no list of complete trees.
std::optional<std::uint64_t> faceTriangles(std::span<const std::uint32_t> tree);

/// The trees of consecutive ranges of triangles. @param ends  behind each range, ascending, the last one behind all
/// triangles   nullopt: a tree crosses the border of a range
std::optional<std::vector<FaceTree>> splitFaceTrees(std::span<const std::uint32_t> tree,
                                                    std::span<const std::uint32_t> ends);

}  // namespace jalousie::asset
