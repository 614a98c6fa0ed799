// Groups by dividing triangles in space and direction, then joining parts where one test costs less than two.
#include "asset/face_groups.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/check.h"

namespace jalousie::asset {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Share of the median inradius below which a triangle is thin.
constexpr double kThinFacet = 1.0 / 8.0;
/// Triangles from which on parts are not halved further.
constexpr std::size_t kLeastPart = 4;
/// A part has at least this share of the triangles that are divided, so that trees are not deep.
constexpr std::size_t kMostUneven = 16;
/// Size of the space that the eye is expected in, in sizes of the object.
constexpr double kEyeSpace = 3.0;
constexpr std::uint32_t kEyes = 128;

// Meshlets of the size that meshoptimizer's manual recommends, with the weight of facing that it recommends for culling
// by cones.
constexpr std::size_t kMeshletVertices = 64;
constexpr std::size_t kMeshletTriangles = 124;
constexpr float kMeshletConeWeight = 0.5F;

int majorAxis(const glm::dvec3& v) {
  const glm::dvec3 a = glm::abs(v);
  if (a.x >= a.y && a.x >= a.z) return 0;
  return a.y >= a.z ? 1 : 2;
}

/// The radical inverse: Halton's sequence in one base.
double radicalInverse(std::uint32_t index, std::uint32_t base) {
  double result = 0.0;
  double digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= base;
    result += digit * (index % base);
  }
  return result;
}

/// Points where the eye is expected, evenly in a box about the object.
std::vector<Eye> expectedEyes(const Aabb& bounds) {
  const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
  const glm::dvec3 extent = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
  const double side = kEyeSpace * std::max({extent.x, extent.y, extent.z});
  std::vector<Eye> eyes;
  for (std::uint32_t i = 1; i <= kEyes; ++i) {
    const glm::dvec3 at(radicalInverse(i, 2), radicalInverse(i, 3), radicalInverse(i, 5));
    eyes.emplace_back(middle + side * (at - 0.5), 1.0);
  }
  return eyes;
}

/// Makes clusters: divides in six dimensions, then joins from the leaves up.
class Clusters {
 public:
  Clusters(std::span<const Triangle> triangles, std::span<const Facet> facets, const Aabb& bounds)
      : triangles_(triangles), facets_(facets), eyes_(expectedEyes(bounds)) {
    scale_ = 1.0 / std::max(double{bounds.diagonal()}, std::numeric_limits<double>::min());
  }

  /// Appends the tree of some triangles, and puts them in its order.
  void run(std::span<std::uint32_t> part, FaceTree& tree) {
    const Node node = build(part);
    append(node, tree);
  }

 private:
  /// Parts first; without parts a group.
  struct Node {
    std::vector<Node> parts;
    std::span<std::uint32_t> triangles;
    double cost = 0.0;  ///< expected, of the groups below, in triangles
  };

  /// Recursion ends: a part has at most 15/16 of the triangles.
  Node build(std::span<std::uint32_t> part) const {
    Node node;
    node.triangles = part;
    node.cost = costOf(part);
    if (part.size() <= kLeastPart) return asGroup(std::move(node));
    const std::size_t half = split(part);
    Node first = build(part.first(half));
    Node second = build(part.subspan(half));
    // T(X) < T(A) + T(B): the condition of the lecture with -t/r.
    if (node.cost <= first.cost + second.cost) return asGroup(std::move(node));
    node.cost = first.cost + second.cost;
    node.parts.push_back(std::move(first));
    node.parts.push_back(std::move(second));
    return node;
  }

  static Node asGroup(Node node) {
    std::sort(node.triangles.begin(), node.triangles.end());
    return node;
  }

  static void append(const Node& node, FaceTree& tree) {
    if (node.parts.empty()) {
      tree.push_back(static_cast<std::uint32_t>(node.triangles.size()));
      return;
    }
    tree.push_back(0);
    for (const Node& part : node.parts)
      append(part, tree);
  }

  /// t / r + (1 - P) n: a test, and the triangles unless they are culled.
  double costOf(std::span<const std::uint32_t> part) const {
    std::vector<Facet> facets;
    facets.reserve(part.size());
    Aabb bounds;
    for (const std::uint32_t t : part) {
      facets.push_back(facets_[t]);
      for (const glm::vec3& corner : triangles_[t])
        bounds.add(corner);
    }
    const CullingVolume volume = volumeOf(facets, bounds);
    const auto culled = std::count_if(eyes_.begin(), eyes_.end(), [&](const Eye& e) { return volume.slack(e) > 0.0; });
    const double share = static_cast<double>(culled) / static_cast<double>(eyes_.size());
    return kFaceTestCost + (1.0 - share) * static_cast<double>(part.size());
  }

  /// Components of the normal, then of the place in sizes of the object: a normal has a range of 2.
  double coordinate(std::uint32_t t, int dimension) const {
    if (dimension < 3) return 0.5 * facets_[t].normal[dimension];
    const Triangle& triangle = triangles_[t];
    const int axis = dimension - 3;
    return scale_ * (double{triangle[0][axis]} + double{triangle[1][axis]} + double{triangle[2][axis]}) / 3.0;
  }

  struct Range {
    int dimension = 0;
    double low = 0.0;
    double high = -1.0;
  };

  Range widest(std::span<const std::uint32_t> part) const {
    Range best;
    for (int k = 0; k < 6; ++k) {
      Range own{k, kInfinity, -kInfinity};
      for (const std::uint32_t t : part) {
        const double x = coordinate(t, k);
        own.low = std::min(own.low, x);
        own.high = std::max(own.high, x);
      }
      if (own.high - own.low > best.high - best.low) best = own;
    }
    return best;
  }

  /// Parts at the middle of the widest range, so that equal normals stay together; where a part would be too small, at
  /// the median. @return  triangles of the first part
  std::size_t split(std::span<std::uint32_t> part) const {
    const Range range = widest(part);
    const double middle = 0.5 * (range.low + range.high);
    const auto at = std::partition(part.begin(), part.end(),
                                   [&](std::uint32_t t) { return coordinate(t, range.dimension) < middle; });
    const auto first = static_cast<std::size_t>(at - part.begin());
    if (std::min(first, part.size() - first) >= part.size() / kMostUneven + 1) return first;
    const std::size_t half = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = coordinate(a, range.dimension);
                       const double y = coordinate(b, range.dimension);
                       return x < y || (x == y && a < b);
                     });
    return half;
  }

  std::span<const Triangle> triangles_;
  std::span<const Facet> facets_;
  std::vector<Eye> eyes_;
  double scale_ = 1.0;
};

/// Sorts by the cells of the normals. @return  a group for each cell that has triangles
FaceTree sortByNormal(std::span<std::uint32_t> part, std::span<const Facet> facets) {
  const auto cellOf = [&](std::uint32_t t) { return normalCell(facets[t].normal).number(); };
  std::stable_sort(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) { return cellOf(a) < cellOf(b); });
  FaceTree tree;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (i == 0 || cellOf(part[i]) != cellOf(part[i - 1])) tree.push_back(0);
    ++tree.back();
  }
  return tree;
}

/// Corners of triangles that share those of equal position.
struct Corners {
  std::vector<unsigned int> indices;  ///< [3 * triangles]
  std::size_t count = 0;              ///< of different positions
  std::vector<glm::vec3> positions;   ///< [count]
};

Corners cornersOf(std::span<const Triangle> triangles, std::span<const std::uint32_t> part) {
  std::vector<glm::vec3> corners;
  for (const std::uint32_t t : part)
    corners.insert(corners.end(), triangles[t].begin(), triangles[t].end());
  Corners result;
  result.indices.resize(corners.size());
  result.count = meshopt_generateVertexRemap(result.indices.data(), nullptr, corners.size(), corners.data(),
                                             corners.size(), sizeof(glm::vec3));
  result.positions.resize(result.count);
  for (std::size_t i = 0; i < corners.size(); ++i)
    result.positions[result.indices[i]] = corners[i];
  return result;
}

/// Sorts by meshlet. Meshoptimizer returns the corners of a meshlet's triangles, not their numbers: of triangles with
/// the same corners, the first that is left is taken. @param part  none is degenerate
/// @return  a group for each meshlet
FaceTree sortByMeshlet(std::span<std::uint32_t> part, std::span<const Triangle> triangles) {
  const Corners corners = cornersOf(triangles, part);
  std::multimap<std::array<unsigned int, 3>, std::uint32_t> numbers;  // equal keys keep their order
  for (std::size_t i = 0; i < part.size(); ++i)
    numbers.emplace(std::array{corners.indices[3 * i], corners.indices[3 * i + 1], corners.indices[3 * i + 2]},
                    part[i]);
  std::vector<meshopt_Meshlet> meshlets(
      meshopt_buildMeshletsBound(corners.indices.size(), kMeshletVertices, kMeshletTriangles));
  std::vector<unsigned int> vertices(meshlets.size() * kMeshletVertices);
  std::vector<unsigned char> locals(meshlets.size() * kMeshletTriangles * 3);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), locals.data(), corners.indices.data(),
                                        corners.indices.size(), &corners.positions[0].x, corners.count,
                                        sizeof(glm::vec3), kMeshletVertices, kMeshletTriangles, kMeshletConeWeight));
  FaceTree tree;
  std::size_t at = 0;
  for (const meshopt_Meshlet& meshlet : meshlets) {
    const std::size_t first = at;
    for (std::size_t k = 0; k < meshlet.triangle_count; ++k) {
      const unsigned char* local = &locals[meshlet.triangle_offset + 3 * k];
      const auto corner = [&](std::size_t c) { return vertices[meshlet.vertex_offset + local[c]]; };
      const auto found = numbers.find({corner(0), corner(1), corner(2)});
      JAL_CHECK((found != numbers.end()));
      part[at++] = found->second;
      numbers.erase(found);
    }
    std::sort(part.begin() + static_cast<std::ptrdiff_t>(first), part.begin() + static_cast<std::ptrdiff_t>(at));
    tree.push_back(static_cast<std::uint32_t>(meshlet.triangle_count));
  }
  JAL_CHECK(at == part.size());
  return tree;
}

/// Moves thin triangles behind the others, both in their order. @return  the number of the others
std::size_t putThinLast(std::vector<std::uint32_t>& order, std::span<const Facet> facets) {
  std::vector<double> radii;
  for (const Facet& facet : facets)
    radii.push_back(facet.inradius);
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  const double least = kThinFacet * *middle;
  const auto thin = std::stable_partition(order.begin(), order.end(), [&](std::uint32_t t) {
    return facets[t].inradius > 0.0 && facets[t].inradius >= least;
  });
  return static_cast<std::size_t>(thin - order.begin());
}

}  // namespace

Facet facetOf(const Triangle& triangle) {
  const glm::dvec3 a(triangle[0]);
  const glm::dvec3 b(triangle[1]);
  const glm::dvec3 c(triangle[2]);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::length(normal);  // twice the area
  const double perimeter = glm::length(b - a) + glm::length(c - b) + glm::length(a - c);
  if (!(area > 0.0) || !std::isfinite(area)) return {glm::dvec3(0.0), a, 0.0};
  return {normal / area, a, area / perimeter};
}

double CullingVolume::support(const glm::dvec3& x) const {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
    sum += x[k] * (x[k] > 0.0 ? highest[k] : lowest[k]);
  return sum;
}

double CullingVolume::slack(const Eye& eye) const {
  return least * eye.w - support(glm::dvec3(eye) - eye.w * origin);
}

bool CullingVolume::isFront(const Eye& eye) const {
  return -support(eye.w * origin - glm::dvec3(eye)) > most * eye.w;
}

CullingVolume volumeOf(std::span<const Facet> facets, const Aabb& bounds) {
  JAL_CHECK(!facets.empty());
  CullingVolume volume{glm::dvec3(kInfinity), glm::dvec3(-kInfinity), {}, -kInfinity, 0.0};
  for (const Facet& facet : facets) {
    volume.lowest = glm::min(volume.lowest, facet.normal);
    volume.highest = glm::max(volume.highest, facet.normal);
  }
  for (int candidate = 0; candidate < 9; ++candidate) {
    glm::vec3 at = 0.5F * bounds.min + 0.5F * bounds.max;
    for (int k = 0; candidate < 8 && k < 3; ++k)
      at[k] = (candidate >> k & 1) != 0 ? bounds.max[k] : bounds.min[k];
    double least = kInfinity;
    double most = -kInfinity;
    for (const Facet& facet : facets) {
      const double distance = glm::dot(facet.normal, facet.corner - glm::dvec3(at));
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
    if (!(least > volume.least)) continue;
    volume.origin = at;
    volume.least = least;
    volume.most = most;
  }
  return volume;
}

CullingVolume unite(const CullingVolume& a, const CullingVolume& b, const glm::vec3& origin) {
  CullingVolume both;
  both.lowest = glm::min(a.lowest, b.lowest);
  both.highest = glm::max(a.highest, b.highest);
  both.origin = origin;
  both.least = std::min(a.least - a.support(both.origin - a.origin), b.least - b.support(both.origin - b.origin));
  both.most = std::max(a.most + a.support(a.origin - both.origin), b.most + b.support(b.origin - both.origin));
  return both;
}

std::uint32_t NormalCell::number() const {
  constexpr std::uint32_t kCells = 16;
  return (side * kCells + row) * kCells + (row % 2 == 0 ? column : kCells - 1 - column);
}

NormalCell normalCell(const glm::dvec3& normal) {
  constexpr double kCells = 16.0;
  const int axis = majorAxis(normal);
  const double major = std::abs(normal[axis]);
  const auto line = [&](int k) {
    const double at = std::floor(0.5 * kCells * (normal[(axis + k) % 3] / major + 1.0));
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, kCells - 1.0));
  };
  const std::uint32_t side = 2 * static_cast<std::uint32_t>(axis) + (normal[axis] < 0.0 ? 1U : 0U);
  return {side, line(1), line(2)};
}

FaceOrder groupFaces(std::span<const Triangle> triangles, const Aabb& bounds, FaceGrouping grouping) {
  FaceOrder result;
  result.triangles.resize(triangles.size());
  std::iota(result.triangles.begin(), result.triangles.end(), 0U);
  if (triangles.empty()) return result;
  std::vector<Facet> facets;
  facets.reserve(triangles.size());
  for (const Triangle& triangle : triangles)
    facets.push_back(facetOf(triangle));
  const std::size_t thick = putThinLast(result.triangles, facets);
  const std::span<std::uint32_t> grouped = std::span(result.triangles).first(thick);
  if (grouping == FaceGrouping::kMasks) {
    result.tree = sortByNormal(grouped, facets);
  } else if (thick > 0 && grouping == FaceGrouping::kMeshlets) {
    result.tree = sortByMeshlet(grouped, triangles);
  } else if (thick > 0) {
    Clusters(triangles, facets, bounds).run(grouped, result.tree);
  }
  if (thick < triangles.size()) result.tree.push_back(static_cast<std::uint32_t>(triangles.size() - thick));
  return result;
}

std::optional<std::uint64_t> faceTriangles(std::span<const std::uint32_t> tree) {
  std::uint64_t triangles = 0;  // of less than 2^32 numbers below 2^32: cannot wrap
  std::uint64_t open = 0;       // parts that are still to come
  for (const std::uint32_t number : tree) {
    if (open == 0) open = 1;
    open = number == 0 ? open + 1 : open - 1;
    triangles += number;
  }
  if (open > 0) return std::nullopt;
  return triangles;
}

std::optional<std::vector<FaceTree>> splitFaceTrees(std::span<const std::uint32_t> tree,
                                                    std::span<const std::uint32_t> ends) {
  std::vector<FaceTree> ranges(ends.size());
  std::size_t range = 0;
  std::uint64_t at = 0;    // triangles so far
  std::uint64_t open = 0;  // parts of the present tree that are still to come
  for (const std::uint32_t number : tree) {
    if (open == 0) {
      while (range < ends.size() && ends[range] <= at)
        ++range;
      open = 1;
    }
    if (range == ends.size()) return std::nullopt;
    ranges[range].push_back(number);
    open = number == 0 ? open + 1 : open - 1;
    at += number;
    if (at > ends[range]) return std::nullopt;
  }
  return ranges;
}

}  // namespace jalousie::asset
