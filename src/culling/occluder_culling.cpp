// Depth first over the flat array: a parent is met before its children.
#include "culling/occluder_culling.h"

#include <algorithm>

#include "core/check.h"
#include "shared/limits.h"

namespace jalousie::culling {
namespace {

constexpr std::uint32_t kWordBits = 32;

Aabb grown(const QueryView& view, const Aabb& box) {
  const float growth = shadowGrowth(view, box);
  return {box.min - growth, box.max + growth};
}

}  // namespace

float shadowGrowth(const QueryView& view, const Aabb& boxWorld) {
  const glm::vec3 reach = glm::max(glm::abs(boxWorld.min), glm::abs(boxWorld.max)) + glm::abs(view.eyeWorld);
  return queryGrowth(view, boxWorld) + gpu::kRounding * std::max({reach.x, reach.y, reach.z});
}

bool isShaded(const QueryView& view, std::span<const CastShadow> shadows, const Aabb& boxWorld) {
  std::uint64_t tests = 0;
  const Aabb box = grown(view, boxWorld);
  return std::any_of(shadows.begin(), shadows.end(),
                     [&](const CastShadow& shadow) { return shadedBy(shadow.planes, box, tests) == Shaded::kFully; });
}

OccluderCulling::OccluderCulling(std::size_t nodes, std::size_t objects)
    : open_(nodes), notHidden_((objects + kWordBits - 1) / kWordBits) {}

OccluderCulling::Test OccluderCulling::test(const QueryView& view, std::span<const CastShadow> shadows,
                                            std::uint32_t among, const Aabb& box, QueryFigures& figures) const {
  Test result;
  if (among == 0) return result;
  const Aabb tested = grown(view, box);
  for (std::uint32_t i = 0; i < shadows.size(); ++i) {
    if ((among >> i & 1U) == 0) continue;
    const Shaded shaded = shadedBy(shadows[i].planes, tested, figures.planeTests);
    if (shaded == Shaded::kFully) return {.hidden = true, .shadows = 0};
    if (shaded == Shaded::kPartly) result.shadows |= 1U << i;
  }
  return result;
}

void OccluderCulling::hide(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t place = first; place < first + count; ++place)
    notHidden_[place / kWordBits] &= ~(1U << place % kWordBits);
}

std::span<const std::uint32_t> OccluderCulling::cull(const SpatialHierarchy& tree, const QueryView& view,
                                                     std::span<const CastShadow> shadows, QueryFigures& figures) {
  JAL_CHECK(shadows.size() <= kMostActive);
  if (open_.size() < tree.nodes.size()) open_.resize(tree.nodes.size());
  std::fill(notHidden_.begin(), notHidden_.end(), ~0U);
  const Open all{kAllPlanes, static_cast<std::uint32_t>((std::uint64_t{1} << shadows.size()) - 1)};
  std::uint32_t n = 0;
  while (n < tree.nodes.size() && all.shadows != 0) {
    const HierarchyNode& node = tree.nodes[n];
    const Open above = node.parent == kNoParent ? all : open_[node.parent];
    ++figures.nodesVisited;
    const PlaneTests planes = view.frustum.test(node.boundsWorld, above.planes);
    figures.planeTests += planes.tested;
    const Test found = planes.outside ? Test{} : test(view, shadows, above.shadows, node.boundsWorld, figures);
    if (found.hidden) hide(node.firstObject, node.objectCount);
    if (found.shadows == 0) {  // outside, hidden, or beside all shadows
      n = node.skip;
      continue;
    }
    open_[n] = {planes.crossed, found.shadows};
    for (std::uint32_t i = 0; tree.isLeaf(n) && node.objectCount > 1 && i < node.objectCount; ++i) {
      const std::uint32_t place = node.firstObject + i;
      ++figures.nodesVisited;
      if (test(view, shadows, found.shadows, tree.objectBounds[place], figures).hidden) hide(place, 1);
    }
    ++n;
  }
  return notHidden_;
}

}  // namespace jalousie::culling
