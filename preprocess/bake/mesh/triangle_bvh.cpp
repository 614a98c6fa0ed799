// Builds the hierarchy by median splits and searches it iteratively, four boxes or triangles at a time.
#include "bake/mesh/triangle_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/aabb.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// A squared distance of which single precision tells no more: no triangle can be found to be nearer.
constexpr float kTouching = 1e-14F;

/// Nearest point of a segment as the parameter in [0, 1] from a to b.
double nearestOnSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  return length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
}

NearestPoint withBarycentric(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                             const glm::dvec3& barycentric) {
  const glm::dvec3 d = p - (barycentric.x * a + barycentric.y * b + barycentric.z * c);
  return {glm::dot(d, d), ~0U, barycentric};
}

/// The nearest of the three edges, for triangles without area.
NearestPoint nearestOnEdges(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double ab = nearestOnSegment(p, a, b);
  const double bc = nearestOnSegment(p, b, c);
  const double ca = nearestOnSegment(p, c, a);
  const std::array<NearestPoint, 3> edges = {withBarycentric(p, a, b, c, {1.0 - ab, ab, 0.0}),
                                             withBarycentric(p, a, b, c, {0.0, 1.0 - bc, bc}),
                                             withBarycentric(p, a, b, c, {ca, 0.0, 1.0 - ca})};
  return *std::min_element(edges.begin(), edges.end(),
                           [](const NearestPoint& x, const NearestPoint& y) { return x.distance2 < y.distance2; });
}

}  // namespace

NearestPoint nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 ap = p - a;
  const double d1 = glm::dot(ab, ap);
  const double d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {glm::dot(ap, ap), ~0U, {1.0, 0.0, 0.0}};
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp);
  const double d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {glm::dot(bp, bp), ~0U, {0.0, 1.0, 0.0}};
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp);
  const double d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {glm::dot(cp, cp), ~0U, {0.0, 0.0, 1.0}};
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  if (va > 0.0 && vb > 0.0 && vc > 0.0) {
    const double scale = 1.0 / (va + vb + vc);
    return withBarycentric(p, a, b, c, {va * scale, vb * scale, vc * scale});
  }
  return nearestOnEdges(p, a, b, c);
}

double squaredDistanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return nearestOnTriangle(p, a, b, c).distance2;
}

namespace {

/// The power of two that brings the diagonal of the triangles' box to about 1; 1 if there is none.
float unitScale(std::span<const TriangleBvh::Corners> triangles) {
  Aabb box;
  for (const TriangleBvh::Corners& t : triangles) {
    box.add(t.a);
    box.add(t.b);
    box.add(t.c);
  }
  const double diagonal = box.diagonal();
  if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return 1.0F;
  return std::ldexp(1.0F, std::clamp(-std::ilogb(diagonal), -120, 120));
}

}  // namespace

TriangleBvh::TriangleBvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
  JAL_CHECK(indices.size() >= 3U);
  JAL_CHECK(indices.size() / 3 < kLeaf);
  triangles_.resize(indices.size() / 3);
  std::vector<Item> items(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      JAL_CHECK(indices[3 * t + k] < positions.size());
    triangles_[t] = {positions[indices[3 * t]], positions[indices[3 * t + 1]], positions[indices[3 * t + 2]]};
  }
  scale_ = unitScale(triangles_);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Corners& corners = triangles_[t];
    items[t] = {scale_ * corners.a + scale_ * corners.b + scale_ * corners.c, static_cast<std::uint32_t>(t)};
  }
  packets_.reserve(items.size() / 4 + 1);
  nodes_.reserve(items.size() / 8 + 1);
  Box box;
  root_ = build(items, box);
}

std::size_t TriangleBvh::split(std::span<Item> items) {
  glm::vec3 low(kInfinity);
  glm::vec3 high(-kInfinity);
  for (const Item& item : items) {
    low = glm::min(low, item.center);
    high = glm::max(high, item.center);
  }
  const glm::vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t half = (items.size() / 2 + 3) / 4 * 4;  // whole packets on one side
  // Ties are broken by the lower index, so the tree does not depend on the library's partition.
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [axis](const Item& a, const Item& b) {
                     return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                             : a.triangle < b.triangle;
                   });
  return half;
}

std::uint32_t TriangleBvh::makePacket(std::span<const Item> items, Box& box) {
  Packet packet;
  box = {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (std::size_t k = 0; k < 4; ++k) {
    const Item& item = items[std::min(k, items.size() - 1)];
    const Corners& source = triangles_[item.triangle];
    const Corners t = {scale_ * source.a, scale_ * source.b, scale_ * source.c};
    packet.a.x[k] = t.a.x, packet.a.y[k] = t.a.y, packet.a.z[k] = t.a.z;
    packet.b.x[k] = t.b.x, packet.b.y[k] = t.b.y, packet.b.z[k] = t.b.z;
    packet.c.x[k] = t.c.x, packet.c.y[k] = t.c.y, packet.c.z[k] = t.c.z;
    packet.id[k] = item.triangle;
    box.min = glm::min(glm::min(box.min, t.a), glm::min(t.b, t.c));
    box.max = glm::max(glm::max(box.max, t.a), glm::max(t.b, t.c));
  }
  packets_.push_back(packet);
  return kLeaf | static_cast<std::uint32_t>(packets_.size() - 1);
}

std::uint32_t TriangleBvh::build(std::span<Item> items, Box& box) {
  if (items.size() <= 4) return makePacket(items, box);
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const std::size_t half = split(items);
  std::array<std::span<Item>, 4> quarters = {items.first(half), {}, items.subspan(half), {}};
  for (const std::size_t side : {0U, 2U}) {
    if (quarters[side].size() <= 4) continue;
    const std::size_t quarter = split(quarters[side]);
    quarters[side + 1] = quarters[side].subspan(quarter);
    quarters[side] = quarters[side].first(quarter);
  }
  box = {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (std::size_t k = 0; k < 4; ++k) {
    Box child{glm::vec3(kInfinity), glm::vec3(kInfinity)};
    const std::uint32_t index = quarters[k].empty() ? 0 : build(quarters[k], child);
    Node& node = nodes_[self];  // building children moves the nodes
    node.child[k] = index;
    node.min.x[k] = child.min.x, node.min.y[k] = child.min.y, node.min.z[k] = child.min.z;
    node.max.x[k] = child.max.x, node.max.y[k] = child.max.y, node.max.z[k] = child.max.z;
    if (quarters[k].empty()) continue;
    box.min = glm::min(box.min, child.min);
    box.max = glm::max(box.max, child.max);
  }
  return self;
}

namespace {

using Float4 [[gnu::vector_size(16)]] = float;

Float4 all(float value) {
  return Float4{value, value, value, value};
}
Float4 larger(Float4 a, Float4 b) {
  return a > b ? a : b;
}
Float4 smaller(Float4 a, Float4 b) {
  return a < b ? a : b;
}

template <class V>
Float4 dot4(const V& a, const V& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
V minus4(const V& a, const V& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Squared distance from the origin to the segment from a along e.
template <class V>
Float4 segmentDistances(const V& a, const V& e) {
  const Float4 length2 = larger(dot4(e, e), all(std::numeric_limits<float>::min()));
  const Float4 t = smaller(larger(-dot4(a, e) / length2, all(0.0F)), all(1.0F));
  const V d = {a.x + t * e.x, a.y + t * e.y, a.z + t * e.z};
  return dot4(d, d);
}

}  // namespace

TriangleBvh::Float4 TriangleBvh::packetDistances(const Packet& packet, const glm::vec3& p) {
  const Vec4 origin = {all(p.x), all(p.y), all(p.z)};
  const Vec4 a = minus4(packet.a, origin);
  const Vec4 b = minus4(packet.b, origin);
  const Vec4 ab = minus4(packet.b, packet.a);
  const Vec4 ac = minus4(packet.c, packet.a);
  const Vec4 bc = minus4(packet.c, packet.b);
  const Float4 edges = smaller(smaller(segmentDistances(a, ab), segmentDistances(b, bc)), segmentDistances(a, ac));
  // If the point projects into the triangle, the plane is nearest. Slivers are measured by their edges.
  const Float4 d00 = dot4(ab, ab);
  const Float4 d01 = dot4(ab, ac);
  const Float4 d11 = dot4(ac, ac);
  const Float4 d20 = -dot4(a, ab);
  const Float4 d21 = -dot4(a, ac);
  const Float4 denominator = d00 * d11 - d01 * d01;
  const Float4 v = d11 * d20 - d01 * d21;
  const Float4 w = d00 * d21 - d01 * d20;
  const Vec4 n = {ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
  const Float4 height = dot4(a, n);
  const Float4 plane = height * height / larger(dot4(n, n), all(std::numeric_limits<float>::min()));
  const auto inside = (v >= 0.0F) & (w >= 0.0F) & (v + w <= denominator) & (denominator > 1e-6F * d00 * d11);
  return inside ? smaller(plane, edges) : edges;
}

template <class Accepts>
inline void TriangleBvh::searchPacket(const Packet& packet, const glm::vec3& point, const Accepts& accepts,
                                      Search& search) {
  const Float4 distances = packetDistances(packet, point);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(distances[k] < search.best) || !accepts(packet.id[k])) continue;
    search.best = distances[k];
    search.triangle = packet.id[k];
  }
}

inline void TriangleBvh::pushChildren(const Node& node, const Vec4& p, Search& search) {
  const Float4 zero = all(0.0F);
  const Float4 dx = larger(larger(node.min.x - p.x, p.x - node.max.x), zero);
  const Float4 dy = larger(larger(node.min.y - p.y, p.y - node.max.y), zero);
  const Float4 dz = larger(larger(node.min.z - p.z, p.z - node.max.z), zero);
  const Float4 distances = (dx * dx + dy * dy + dz * dz) * 0.99999F;
  const std::size_t first = search.size;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(distances[k] <= search.best) || distances[k] == kInfinity) continue;
    // Insertion keeps the nearest child on top.
    std::size_t at = search.size++;
    for (; at > first && search.stack[at - 1].distance2 < distances[k]; --at)
      search.stack[at] = search.stack[at - 1];
    search.stack[at] = {node.child[k], distances[k]};
  }
}

template <class Accepts>
inline void TriangleBvh::search(const glm::vec3& point, const Accepts& accepts, Search& search) const {
  search.stack[search.size++] = {root_, 0.0F};
  const glm::vec3 scaled = scale_ * point;
  const Vec4 p = {all(scaled.x), all(scaled.y), all(scaled.z)};
  while (search.size > 0 && search.best > kTouching) {
    const Search::Entry entry = search.stack[--search.size];
    if (entry.distance2 > search.best) continue;
    if ((entry.node & kLeaf) != 0) {
      searchPacket(packets_[entry.node & ~kLeaf], scaled, accepts, search);
    } else {
      pushChildren(nodes_[entry.node], p, search);
    }
  }
}

NearestPoint TriangleBvh::nearestWhere(const glm::vec3& point, double most,
                                       const std::function<bool(std::uint32_t)>& accepts) const {
  Search search;
  search.best = static_cast<float>(most * most * scale_ * scale_);
  this->search(point, accepts, search);
  if (search.triangle == kNoSeed) return {};
  const Corners& t = triangles_[search.triangle];
  NearestPoint result = nearestOnTriangle(point, t.a, t.b, t.c);
  result.triangle = search.triangle;
  return result;
}

NearestPoint TriangleBvh::nearest(const glm::vec3& point, std::uint32_t seed) const {
  Search search;
  search.triangle = seed;
  if (seed != kNoSeed) {
    const Corners& t = triangles_[seed];
    const double scale2 = double{scale_} * scale_;
    search.best = static_cast<float>(nearestOnTriangle(point, t.a, t.b, t.c).distance2 * scale2) * 1.00001F;
  }
  this->search(
      point, [](std::uint32_t) { return true; }, search);
  // If all distances overflowed, any triangle will do.
  const std::uint32_t triangle = search.triangle == kNoSeed ? 0 : search.triangle;
  const Corners& t = triangles_[triangle];
  NearestPoint result = nearestOnTriangle(point, t.a, t.b, t.c);
  result.triangle = triangle;
  return result;
}

double TriangleBvh::distance(const glm::vec3& point, std::uint32_t seed) const {
  return std::sqrt(nearest(point, seed).distance2);
}

}  // namespace jalousie::bake
