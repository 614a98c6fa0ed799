// Which occluders are worth testing against: the few that cover most of the view.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "culling/hierarchy.h"
#include "culling/occluder_options.h"
#include "culling/shadow.h"
#include "scene/scene_data.h"

namespace jalousie::culling {

/// How solids are used.
enum class OccluderUse : std::uint8_t {
  kSolids,   ///< as they are
  kPolygons  ///< face by face
};

/// An occluder of an object.
struct PlacedOccluder {
  std::uint32_t shape = 0;  ///< index into OccluderTable::shapes()
  std::uint32_t object = 0;
  glm::dvec3 center{0.0};  ///< of a sphere around it, world space
  double radius = 0.0;
};

/// The occluders of all objects of a scene.
class OccluderTable {
 public:
  /// @param scene  with objects sorted by chain
  OccluderTable(const scene::SceneData& scene, OccluderUse use);

  /// Follows objects that moved. Allocates nothing. @param transforms  by gpu::Object::transform
  void follow(std::span<const gpu::Object> objects, std::span<const gpu::Transform> transforms);
  const std::vector<PlacedOccluder>& placed() const { return placed_; }
  const OccluderShape& shapeOf(const PlacedOccluder& occluder) const { return shapes_[occluder.shape].convex; }
  /// Whether it lies inside every level of its object; all lie inside LOD 0.
  bool holdsForEveryLevel(const PlacedOccluder& occluder) const { return shapes_[occluder.shape].everyLevel; }
  /// Whether it is known to lie on the object's surface: then only itself must lie beyond the near plane.
  bool isSurface(const PlacedOccluder& occluder) const { return shapes_[occluder.shape].isSurface; }

 private:
  struct Shape {
    OccluderShape convex;
    bool everyLevel = false;
    bool isSurface = false;
    glm::dvec3 center{0.0};  ///< object space
    double radius = 0.0;
  };
  std::vector<Shape> shapes_;
  std::vector<PlacedOccluder> placed_;
};

/// A matrix of a transform, in double precision.
glm::dmat4 matrixOf(const gpu::Transform& transform);

/// What a choice of occluders needs of a frame.
struct OccluderScene {
  const OccluderTable& table;
  std::span<const gpu::Object> objects;
  std::span<const gpu::Transform> transforms;
  std::span<const Aabb> boundsWorld;  ///< by object
  bool everyLevel = true;             ///< levels beyond LOD 0 may be drawn
};

/// A shadow in use.
struct CastShadow {
  std::uint32_t occluder = 0;  ///< index into OccluderTable::placed()
  std::vector<ShadowPlane> planes;
};

/// Keeps the choice between frames, and casts the shadows anew in every frame.
class ActiveSet {
 public:
  /// @param most  occluders that are ever placed
  explicit ActiveSet(std::size_t most);

  /// The shadows of one frame. Allocates nothing. An occluder takes part if it lies beyond the near plane with its
  /// whole object (or alone, where it is on the surface), if its object is drawn at levels that hold it, and if its
  /// shadow exists from here.
  std::span<const CastShadow> cast(const QueryView& view, const OccluderOptions& options, const OccluderScene& scene);
  void forget() { age_ = 0; }

 private:
  struct Ranked {
    double measure;
    std::uint32_t occluder;
    /// Larger first; equal ones by number.
    friend bool operator<(const Ranked& a, const Ranked& b) {
      return a.measure != b.measure ? a.measure > b.measure : a.occluder < b.occluder;
    }
  };
  bool isUsable(std::uint32_t occluder, const QueryView& view, const OccluderScene& scene);
  void choose(const QueryView& view, const OccluderOptions& options, const OccluderScene& scene);

  std::vector<Ranked> bounds_;  ///< [placed] heap by upper bound
  std::vector<Ranked> chosen_;
  std::vector<CastShadow> shadows_;
  WorldOccluder scratch_;
  std::vector<ShadowPlane> planes_;
  std::uint32_t age_ = 0;  ///< frames until the next choice
};

/// Eye or direction of a view.
Viewpoint viewpointOf(const QueryView& view);

}  // namespace jalousie::culling
