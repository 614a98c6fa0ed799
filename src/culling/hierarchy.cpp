// Builds the tree in depth-first order with a stack of ranges; no recursion.
#include "culling/hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "core/check.h"
#include "culling/hierarchy_build.h"

namespace jalousie::culling {
namespace {

constexpr std::uint32_t kBins = 16;
constexpr std::uint32_t kSahDepth = 32;  ///< below this depth, ranges are halved: 32 more levels hold any 32-bit count
constexpr std::size_t kMostDepth = 64;

/// Center of a box, in double precision: sums and areas of any boxes of floats are finite.
glm::dvec3 centerOf(const Aabb& box) {
  return 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
}

struct Bin {
  Aabb bounds;
  std::uint32_t count = 0;
};

/// A cut of a range: objects whose center lies in bins below `bin` go to the left.
struct Cut {
  int axis = 0;
  std::uint32_t bin = 0;
};

/// The bins of one axis over the centers of a range.
class Axis {
 public:
  Axis(int axis, double low, double high) : axis_(axis), low_(low), extent_(high - low) {}

  bool flat() const { return !(extent_ > 0.0); }
  std::uint32_t binOf(const Aabb& box) const {
    const double place = (centerOf(box)[axis_] - low_) / extent_;
    return std::min(kBins - 1, static_cast<std::uint32_t>(place * kBins));
  }

 private:
  int axis_;
  double low_;
  double extent_;
};

/// A part of the permutation that becomes a subtree.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t parent = kNoParent;
  std::uint32_t depth = 0;
};

/// Makes one hierarchy.
class Builder {
 public:
  /// @param aside  memory for a partition
  Builder(SpatialHierarchy& result, std::vector<std::uint32_t>& aside, std::span<const Aabb> boxes,
          const HierarchyOptions& options)
      : result_(result), aside_(aside), boxes_(boxes), options_(options) {}

  void build() {
    beginHierarchy(result_, boxes_);
    aside_.resize(boxes_.size());
    FixedStack<Range, kMostDepth + 1> stack;
    if (!boxes_.empty()) stack.push({0, static_cast<std::uint32_t>(boxes_.size()), kNoParent, 0});
    while (!stack.empty()) {
      const Range range = stack.pop();
      const std::uint32_t node = appendNode(result_, boxes_, range.parent, objectsOf(range));
      if (range.count <= options_.maxLeafObjects) continue;
      const std::uint32_t left = split(range);
      stack.push({range.first + left, range.count - left, node, range.depth + 1});
      stack.push({range.first, left, node, range.depth + 1});  // on top: the left child is the next node
    }
    finishHierarchy(result_, boxes_);
  }

 private:
  std::span<std::uint32_t> objectsOf(const Range& range) {
    return std::span(result_.objects).subspan(range.first, range.count);
  }

  /// Reorders a range into the objects of its left and of its right child. Returns the number of the left ones.
  std::uint32_t split(const Range& range) {
    const std::optional<Cut> cut = range.depth < kSahDepth ? bestCut(range) : std::nullopt;
    if (!cut) return range.count / 2;
    const std::span<std::uint32_t> objects = objectsOf(range);
    const Axis axis = axisOf(range, cut->axis);
    // A stable partition that allocates nothing.
    std::size_t left = 0;
    std::size_t right = 0;
    for (const std::uint32_t object : objects)
      (axis.binOf(boxes_[object]) < cut->bin ? objects[left++] : aside_[right++]) = object;
    std::copy_n(aside_.begin(), right, objects.subspan(left).begin());
    return static_cast<std::uint32_t>(left);
  }

  Axis axisOf(const Range& range, int axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const std::uint32_t object : objectsOf(range)) {
      const double center = centerOf(boxes_[object])[axis];
      low = std::min(low, center);
      high = std::max(high, center);
    }
    return {axis, low, high};
  }

  /// The cut with the least sum of area times count; the first one among equals. Absent if all centers are equal.
  std::optional<Cut> bestCut(const Range& range) {
    std::optional<Cut> best;
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
      const Axis axis = axisOf(range, a);
      if (axis.flat()) continue;
      std::array<Bin, kBins> bins;
      for (const std::uint32_t object : objectsOf(range)) {
        Bin& bin = bins[axis.binOf(boxes_[object])];
        bin.bounds.add(boxes_[object]);
        ++bin.count;
      }
      const std::array<double, kBins> costs = cutCosts(bins);
      for (std::uint32_t bin = 1; bin < kBins; ++bin) {
        if (!(costs[bin] < least)) continue;
        least = costs[bin];
        best = Cut{a, bin};
      }
    }
    return best;
  }

  /// Cost of the cut in front of each bin; infinite where one side is empty.
  static std::array<double, kBins> cutCosts(const std::array<Bin, kBins>& bins) {
    std::array<double, kBins> costs{};
    Bin below;
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      costs[bin] = costOf(below);
      below.bounds.add(bins[bin].bounds);
      below.count += bins[bin].count;
    }
    Bin above;
    for (std::uint32_t bin = kBins; bin-- > 0;) {
      above.bounds.add(bins[bin].bounds);
      above.count += bins[bin].count;
      costs[bin] += costOf(above);
    }
    return costs;
  }

  static double costOf(const Bin& side) {
    return side.count == 0 ? std::numeric_limits<double>::infinity() : surfaceArea(side.bounds) * side.count;
  }

  SpatialHierarchy& result_;
  std::vector<std::uint32_t>& aside_;
  std::span<const Aabb> boxes_;
  HierarchyOptions options_;
};

void rebuild(SpatialHierarchy& hierarchy, std::vector<std::uint32_t>& aside, std::span<const Aabb> boundsWorld,
             const HierarchyOptions& options) {
  JAL_CHECK(options.maxLeafObjects >= 1U);
  requireBoxes(boundsWorld);
  Builder(hierarchy, aside, boundsWorld, options).build();
}

}  // namespace

SpatialHierarchy buildHierarchy(std::span<const Aabb> boundsWorld, const HierarchyOptions& options) {
  SpatialHierarchy hierarchy;
  std::vector<std::uint32_t> aside;
  rebuild(hierarchy, aside, boundsWorld, options);
  return hierarchy;
}

SpatialHierarchy buildHierarchy(const scene::SceneData& scene, const HierarchyOptions& options) {
  return buildHierarchy(worldBounds(scene.objects, scene.chains, scene.transforms), options);
}

std::vector<Aabb> worldBounds(std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                              std::span<const gpu::Transform> transforms) {
  std::vector<Aabb> boxes(objects.size());
  worldBoundsInto(boxes, objects, chains, transforms);
  return boxes;
}

void worldBoundsInto(std::span<Aabb> boxes, std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                     std::span<const gpu::Transform> transforms) {
  JAL_CHECK(boxes.size() == objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    boxes[i] = worldBounds(chains[objects[i].chain], transforms[objects[i].transform]);
}

double surfaceArea(const Aabb& box) {
  const glm::dvec3 e = glm::dvec3(box.max) - glm::dvec3(box.min);
  return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

double costOf(const SpatialHierarchy& hierarchy) {
  if (hierarchy.nodes.empty()) return 0.0;
  double sum = 0.0;
  for (std::uint32_t n = 0; n < hierarchy.nodes.size(); ++n) {
    const HierarchyNode& node = hierarchy.nodes[n];
    sum += surfaceArea(node.boundsWorld) * (hierarchy.isLeaf(n) ? node.objectCount : 1);
  }
  const double root = surfaceArea(hierarchy.nodes[0].boundsWorld);
  return root > 0.0 ? sum / root : 0.0;
}

void refit(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld) {
  JAL_CHECK(boundsWorld.size() == hierarchy.objects.size());
  requireBoxes(boundsWorld);
  for (std::size_t i = 0; i < hierarchy.objects.size(); ++i)
    hierarchy.objectBounds[i] = boundsWorld[hierarchy.objects[i]];
  // Children stand behind their parents.
  for (auto n = static_cast<std::uint32_t>(hierarchy.nodes.size()); n-- > 0;) {
    HierarchyNode& node = hierarchy.nodes[n];
    node.boundsWorld = {};
    if (hierarchy.isLeaf(n)) {
      for (std::uint32_t i = 0; i < node.objectCount; ++i)
        node.boundsWorld.add(hierarchy.objectBounds[node.firstObject + i]);
    } else {
      node.boundsWorld.add(hierarchy.nodes[n + 1].boundsWorld);
      node.boundsWorld.add(hierarchy.nodes[hierarchy.nodes[n + 1].skip].boundsWorld);
    }
  }
}

MovingHierarchy::MovingHierarchy(std::span<const Aabb> boundsWorld, const HierarchyOptions& options)
    : options_(options) {
  rebuild(tree_, aside_, boundsWorld, options_);
  builtCost_ = costOf(tree_);
}

bool MovingHierarchy::follow(std::span<const Aabb> boundsWorld) {
  constexpr double kWorst = 1.5;
  refit(tree_, boundsWorld);
  if (!(costOf(tree_) > kWorst * builtCost_)) return false;
  rebuild(tree_, aside_, boundsWorld, options_);
  builtCost_ = costOf(tree_);
  return true;
}

Aabb worldBounds(const scene::SceneData& scene, std::uint32_t object) {
  return worldBounds(scene.chains[scene.objects[object].chain], scene.transforms[scene.objects[object].transform]);
}

Aabb worldBounds(const gpu::Chain& chain, const gpu::Transform& transform) {
  Aabb box = transformed(scene::worldFromObject(transform),
                         {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(box.min[axis]) && std::isfinite(box.max[axis])) continue;
    box.min[axis] = std::numeric_limits<float>::lowest();
    box.max[axis] = std::numeric_limits<float>::max();
  }
  return box;
}

}  // namespace jalousie::culling
