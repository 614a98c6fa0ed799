// Frustum culling over a spatial hierarchy (Clark 1976; Assarsson and Moeller 2000), each of its steps for itself, so
// that they can be counted against each other.
#pragma once

#include <cstdint>
#include <vector>

#include "culling/frustum.h"
#include "culling/hierarchy.h"

namespace jalousie::culling {

/// Steps of the test. They change how many planes are tested, never a verdict.
struct FrustumSteps {
  bool hierarchy = true;     ///< Clark: what lies below a node outside is outside
  bool planeMasks = true;    ///< children of a node do not test the planes that it lies inside of
  bool lastPlane = true;     ///< a node tests the plane first that it was outside of in the last frame
  bool sphereFirst = false;  ///< a bounding sphere is tested against each plane before the box
};

/// What a traversal did.
struct FrustumCost {
  std::uint64_t nodes = 0;          ///< met, objects of leaves included
  std::uint64_t planesOfBoxes = 0;  ///< box against plane
  std::uint64_t planesOfSpheres = 0;
};

/// Keeps, from frame to frame, which plane each node and object was outside of.
class FrustumCuller {
 public:
  /// @param tree  outlives the culler; may be fitted anew, but not built anew
  explicit FrustumCuller(const SpatialHierarchy& tree);

  /// Verdicts of one view. @param inside  [objects] by object index: 1 where Frustum::holdsPartOf the object's box
  FrustumCost cull(const Frustum& frustum, const FrustumSteps& steps, std::vector<std::uint8_t>& inside);

 private:
  PlaneTests test(const Frustum& frustum, const FrustumSteps& steps, const Aabb& box, std::uint32_t planes,
                  std::uint8_t& last);
  Frustum::Side side(const Frustum& frustum, const FrustumSteps& steps, const Aabb& box, std::uint32_t plane);

  const SpatialHierarchy& tree_;
  std::vector<std::uint8_t> lastOfNode_;    ///< plane that it was outside of
  std::vector<std::uint8_t> lastOfObject_;  ///< by place in tree.objects
  std::vector<std::uint32_t> planesOf_;     ///< [nodes] planes left to the children
  FrustumCost cost_;
};

}  // namespace jalousie::culling
