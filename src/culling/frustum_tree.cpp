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

FrustumCuller::Verdict FrustumCuller::test(const Frustum& frustum, const FrustumSteps& steps, const Aabb& box,
                                           std::uint32_t planes, std::uint8_t& last) {
  ++cost_.nodes;
  Verdict verdict;
  const std::uint32_t first = steps.lastPlane ? last : 0;
  for (std::uint32_t i = 0; i < kPlanes; ++i) {
    const std::uint32_t plane = (first + i) % kPlanes;
    if ((planes >> plane & 1U) == 0) continue;
    const Frustum::Side where = side(frustum, steps, box, plane);
    if (where == Frustum::Side::kOutside) {
      last = static_cast<std::uint8_t>(plane);
      verdict.outside = true;
      return verdict;
    }
    if (where == Frustum::Side::kCrosses) verdict.planes |= 1U << plane;
  }
  return verdict;
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
    const Verdict verdict = test(frustum, steps, node.boundsWorld, planes, lastOfNode_[n]);
    if (verdict.outside) {
      n = node.skip;
      continue;
    }
    planesOf_[n] = verdict.planes;
    if (tree_.isLeaf(n))
      testObjects(node.firstObject, node.objectCount, steps.planeMasks ? verdict.planes : kAllPlanes);
    ++n;
  }
  return cost_;
}

}  // namespace jalousie::culling
