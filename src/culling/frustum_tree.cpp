// Depth first, with the mask of each node kept for its children.
#include "culling/frustum_tree.h"

#include <algorithm>

namespace jalousie::culling {

FrustumCuller::FrustumCuller(const SpatialHierarchy& tree)
    : tree_(tree), lastOfNode_(tree.nodes.size()), lastOfObject_(tree.objects.size()), planesOf_(tree.nodes.size()) {}

Frustum::Side FrustumCuller::side(const Frustum& frustum, const FrustumSteps& steps, const Aabb& box,
                                  std::uint32_t plane) {
  if (steps.sphereFirst) {
    ++cost_.planesOfSpheres;
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    const Frustum::Side ofSphere = frustum.sideOf(0.5 * (low + high), 0.5 * glm::length(high - low), plane);
    if (ofSphere != Frustum::Side::kCrosses) return ofSphere;
  }
  ++cost_.planesOfBoxes;
  return frustum.sideOf(box, plane);
}

PlaneTests FrustumCuller::test(const Frustum& frustum, const FrustumSteps& steps, const Aabb& box, std::uint32_t planes,
                               std::uint8_t& last) {
  ++cost_.nodes;
  const PlaneTests tests = Frustum::test(planes, steps.lastPlane ? last : 0,
                                         [&](std::uint32_t plane) { return side(frustum, steps, box, plane); });
  if (tests.outside) last = static_cast<std::uint8_t>(tests.last);
  return tests;
}

FrustumCost FrustumCuller::cull(const Frustum& frustum, const FrustumSteps& steps, std::vector<std::uint8_t>& inside) {
  cost_ = {};
  inside.assign(tree_.objects.size(), 0);
  const auto testObjects = [&](std::uint32_t first, std::uint32_t count, std::uint32_t planes) {
    for (std::uint32_t i = first; i < first + count; ++i)
      inside[tree_.objects[i]] = test(frustum, steps, tree_.objectBounds[i], planes, lastOfObject_[i]).outside ? 0 : 1;
  };
  if (!steps.hierarchy) {
    testObjects(0, static_cast<std::uint32_t>(tree_.objects.size()), kAllPlanes);
    return cost_;
  }
  std::uint32_t n = 0;
  while (n < tree_.nodes.size()) {
    const HierarchyNode& node = tree_.nodes[n];
    const std::uint32_t planes = n == 0 || !steps.planeMasks ? kAllPlanes : planesOf_[node.parent];
    const PlaneTests tests = test(frustum, steps, node.boundsWorld, planes, lastOfNode_[n]);
    if (tests.outside) {
      n = node.skip;
      continue;
    }
    planesOf_[n] = tests.crossed;
    if (tree_.isLeaf(n)) testObjects(node.firstObject, node.objectCount, steps.planeMasks ? tests.crossed : kAllPlanes);
    ++n;
  }
  return cost_;
}

}  // namespace jalousie::culling
