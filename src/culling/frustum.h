// Boxes against the view: the flat test that all traversals agree with, and what else queries need to know of a box.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/aabb.h"

namespace jalousie::culling {

/// Planes of a clip volume with reversed depth: left, right, bottom, top, far, near.
inline constexpr std::uint32_t kPlanes = 6;
inline constexpr std::uint32_t kAllPlanes = (1U << kPlanes) - 1;

/// What a test against some planes found.
struct PlaneTests {
  bool outside = false;       ///< of one plane, the last one tested
  std::uint32_t crossed = 0;  ///< planes that the box crosses, one bit each
  std::uint32_t tested = 0;   ///< how many
  std::uint32_t last = 0;     ///< the last one
};

/// The planes of one view. A point p is inside a plane where dot(normal, p) + offset >= 0.
class Frustum {
 public:
  /// @param clipFromWorld  with -w <= x, y <= w and 0 <= z <= w, the near plane at z = w (scene::clipFromWorld)
  explicit Frustum(const glm::mat4& clipFromWorld);

  /// Where a box lies to a plane.
  enum class Side : std::uint8_t { kOutside, kCrosses, kInside };
  /// Tests the corner that is farthest along the plane's normal, then the one that is nearest (p- and n-vertex). A box
  /// counts as outside only beyond the rounding error that the vertex stage may make (kRounding). Monotone: what holds
  /// for a box holds for every box in it, bit for bit.
  Side sideOf(const Aabb& boxWorld, std::uint32_t plane) const;
  /// The same for a sphere; kOutside only where every box in the sphere is outside, too.
  Side sideOf(const glm::dvec3& centerWorld, double radius, std::uint32_t plane) const;
  /// Tests planes one after the other until the box is outside of one.
  /// @param planes  which, one bit each   @param first  the one to begin with   @param side  Side(std::uint32_t plane)
  template <class SideOf>
  static PlaneTests test(std::uint32_t planes, std::uint32_t first, const SideOf& side) {
    PlaneTests tests;
    for (std::uint32_t i = 0; i < kPlanes && !tests.outside; ++i) {
      const std::uint32_t plane = (first + i) % kPlanes;
      if ((planes >> plane & 1U) == 0) continue;
      const Side where = side(plane);
      ++tests.tested;
      tests.last = plane;
      tests.outside = where == Side::kOutside;
      if (where == Side::kCrosses) tests.crossed |= 1U << plane;
    }
    return tests;
  }
  PlaneTests test(const Aabb& boxWorld, std::uint32_t planes = kAllPlanes) const {
    return test(planes, 0, [&](std::uint32_t plane) { return sideOf(boxWorld, plane); });
  }
  /// Whether no plane has the whole box outside: the flat test.
  bool holdsPartOf(const Aabb& boxWorld) const { return !test(boxWorld).outside; }

 private:
  struct Plane {
    glm::dvec3 normal;
    double offset;
    double length;  ///< of the normal
  };
  double roundingAt(const Plane& plane, const glm::dvec3& corner) const;

  std::array<Plane, kPlanes> planes_;
};

/// What a scheduler of queries knows of the camera.
struct QueryView {
  Frustum frustum;
  glm::vec3 eyeWorld;
  glm::vec3 forwardWorld;  ///< unit vector
  bool orthographic = false;
  /// No point of the near rectangle is farther from the eye; for an orthographic camera, from its plane. A box that
  /// lies nearer is taken for visible. World units, with the growth of query boxes.
  float nearReach = 0.0F;
  float pixelWidth = 0.0F;  ///< world units of a pixel at depth 1, or at any depth of an orthographic camera

  /// Distance of the nearest point of a box from the eye, or from the plane of an orthographic camera; 0 inside.
  float distanceTo(const Aabb& boxWorld) const;
  /// Whether the box, grown as its query's is, may reach the near plane: then a query could miss what it shows.
  bool reachesNear(const Aabb& boxWorld) const;
};

/// By how much a query's box is grown on all sides: the width of a pixel at the depth of its farthest corner, so that
/// it covers every sample that its content covers although vertices snap to a grid, and lies in front of it by more
/// than depths are off. GPU twin: shaders/render/query_box.vert
float queryGrowth(const QueryView& view, const Aabb& boxWorld);

/// The view of a culling camera. @param clipFromWorld  as Frustum   @param eyeWorld  xyz, w distance of the near plane
/// @param forwardWorld  xyz unit vector, w 1 for an orthographic camera   @param focalPixels  as scene::focalPixels
/// @param viewport  pixels
QueryView makeQueryView(const glm::mat4& clipFromWorld, const glm::vec4& eyeWorld, const glm::vec4& forwardWorld,
                        float focalPixels, const glm::uvec2& viewport);

}  // namespace jalousie::culling
