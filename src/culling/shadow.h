// The shadow of a convex occluder: everything that a convex solid or polygon hides from the eye.
//
// Hudson et al. 1997 (planar occluders) and the extension to solid occluders: half-spaces of the front faces, cut with
// the planes through the eye and each silhouette edge. Equations: docs/object_space_occlusion.md
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/convex_solid.h"
#include "culling/occluder_options.h"

namespace jalousie::culling {

/// Where a view looks from: a point, or a direction of parallel rays.
struct Viewpoint {
  glm::dvec3 point{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit, into the scene
  bool parallel = false;

  /// From a point of the scene towards the eye; not unit.
  glm::dvec3 toEye(const glm::dvec3& from) const { return parallel ? -direction : point - from; }
};

/// A point p is outside where dot(normal, p) > offset. The normal is unit.
struct ShadowPlane {
  glm::dvec3 normal{0.0};
  double offset = 0.0;

  double distanceTo(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// Most planes of one shadow: all faces and all edges (3 V - 6 at most).
inline constexpr std::size_t kMostShadowPlanes = ConvexSolid::kMostFaces + 3 * ConvexSolid::kMostVertices;

/// A solid with its edges: what does not change when it moves.
struct OccluderShape {
  /// Between two faces; the edges of a polygon have it on both sides.
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t left = 0;
    std::uint32_t right = 0;
  };

  /// @param convex  without faults (faultOf)
  explicit OccluderShape(ConvexSolid convex);

  ConvexSolid solid;
  std::vector<Edge> edges;
};

/// An occluder in the world.
class WorldOccluder {
 public:
  /// At no place yet: place() comes first.
  WorldOccluder();

  /// Takes a shape to its place. Allocates nothing. @param shape  outlives the occluder
  /// @param worldFromObject  affine; may mirror. A face without area in the world makes an occluder that hides nothing
  void place(const OccluderShape& shape, const glm::dmat4& worldFromObject);

  const Aabb& boundsWorld() const { return boundsWorld_; }
  bool isPolygon() const { return shape_->solid.isPolygon(); }

 private:
  friend bool castShadow(const WorldOccluder&, const Viewpoint&, Cap, std::vector<ShadowPlane>&);
  friend double solidAngle(const WorldOccluder&, const Viewpoint&);
  friend double paperRank(const WorldOccluder&, const Viewpoint&);

  struct Face {
    ShadowPlane plane;
    double area = 0.0;
    glm::dvec3 center{0.0};
  };
  bool placeFace(const std::vector<std::uint32_t>& corners, bool mirrors);
  /// Whether the eye is strictly in front of a face.
  bool isFront(const Face& face, const Viewpoint& view) const;
  bool isSilhouette(const OccluderShape::Edge& edge, const Viewpoint& view) const;
  void addFrontPlanes(const Viewpoint& view, std::vector<ShadowPlane>& planes) const;
  bool addSilhouettePlanes(const Viewpoint& view, std::vector<ShadowPlane>& planes) const;
  /// One plane through the deepest point of the silhouette, along the mean direction to the eye.
  ShadowPlane paperCap(const Viewpoint& view) const;

  const OccluderShape* shape_ = nullptr;
  std::vector<glm::dvec3> vertices_;
  std::vector<Face> faces_;  ///< as those of the solid; empty: hides nothing
  glm::dvec3 center_{0.0};
  double radius_ = 0.0;
  Aabb boundsWorld_;
};

/// The planes of a shadow. A point strictly inside all of them is behind the occluder or in it. With Cap::kExact the
/// planes bound exactly what the occluder hides; they are at most kMostShadowPlanes.
/// @param planes  gets them; nothing is allocated where it has room   @return  whether the occluder hides anything: not
/// from within it, from behind a polygon with one side, or from the plane of a polygon
bool castShadow(const WorldOccluder& occluder, const Viewpoint& view, Cap cap, std::vector<ShadowPlane>& planes);

/// How a box lies to a shadow.
enum class Shaded : std::uint8_t {
  kNot,     ///< outside of one plane: no part is hidden by this occluder
  kPartly,  ///< not known: what the box holds may be hidden
  kFully,   ///< strictly inside: all that it holds is hidden
};
/// Exact for boxes that are hidden: a convex shadow holds a box if it holds its corners.
/// @param tests  is increased by the planes tested
Shaded shadedBy(std::span<const ShadowPlane> planes, const Aabb& box, std::uint64_t& tests);

/// Solid angle that the occluder covers, steradians, summed over the triangles of its front faces (Van Oosterom and
/// Strackee 1983); 0 where it hides nothing. For parallel rays the area that the eye sees.
double solidAngle(const WorldOccluder& occluder, const Viewpoint& view);
/// Upper bound of solidAngle for all occluders in a sphere; of the area for parallel rays.
double solidAngleBound(const glm::dvec3& center, double radius, const Viewpoint& view);
/// The published measures: for a polygon -A N.V / |V|^2, with V from the eye to its middle; for a solid its volume over
/// |V|^3. The first grows with the unit of length and the second does not, so that scaling a scene changes their order.
double paperRank(const WorldOccluder& occluder, const Viewpoint& view);

}  // namespace jalousie::culling
