// Median-split hierarchy with an iterative nearest-point search.
#include "bake/triangle_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/check.h"

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

double squaredDistanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 d = p - (a + t * ab);
  return glm::dot(d, d);
}

float squaredDistanceToBox(const glm::vec3& p, const glm::vec3& min, const glm::vec3& max) {
  const glm::vec3 d = glm::max(glm::max(min - p, p - max), glm::vec3(0.0F));
  return glm::dot(d, d);
}

}  // namespace

double squaredDistanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length2 = glm::dot(normal, normal);
  if (length2 > 0.0) {
    // Inside the prism over the triangle the plane is nearest.
    const bool inside = glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
                        glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
                        glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
    if (inside) {
      const double height = glm::dot(p - a, normal);
      return height * height / length2;
    }
  }
  return std::min(
      {squaredDistanceToSegment(p, a, b), squaredDistanceToSegment(p, b, c), squaredDistanceToSegment(p, c, a)});
}

TriangleBvh::TriangleBvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
  JAL_CHECK(indices.size() >= 3U);
  std::vector<Corners> source(indices.size() / 3);
  for (std::size_t t = 0; t < source.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      JAL_CHECK(indices[3 * t + k] < positions.size());
    source[t] = {positions[indices[3 * t]], positions[indices[3 * t + 1]], positions[indices[3 * t + 2]]};
  }
  std::vector<std::uint32_t> order(source.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(source.size());
  build(order, 0, source);
  triangles_.reserve(source.size());
  for (const std::uint32_t t : order)
    triangles_.push_back(source[t]);
}

void TriangleBvh::build(std::span<std::uint32_t> order, std::uint32_t first, std::span<const Corners> source) {
  Node node;
  node.min = glm::vec3(std::numeric_limits<float>::infinity());
  node.max = -node.min;
  glm::vec3 centerMin = node.min;
  glm::vec3 centerMax = node.max;
  for (const std::uint32_t t : order) {
    const Corners& corners = source[t];
    node.min = glm::min(glm::min(node.min, corners.a), glm::min(corners.b, corners.c));
    node.max = glm::max(glm::max(node.max, corners.a), glm::max(corners.b, corners.c));
    const glm::vec3 center = corners.a + corners.b + corners.c;
    centerMin = glm::min(centerMin, center);
    centerMax = glm::max(centerMax, center);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  if (order.size() <= kLeafTriangles) {
    nodes_[self].first = first;
    nodes_[self].count = static_cast<std::uint32_t>(order.size());
    return;
  }
  const glm::vec3 extent = centerMax - centerMin;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto key = [&](std::uint32_t t) { return source[t].a[axis] + source[t].b[axis] + source[t].c[axis]; };
  const std::size_t half = order.size() / 2;
  // Ties fall to the lower index, so the tree does not depend on the library's partition.
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  build(order.first(half), first, source);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  build(order.subspan(half), first + static_cast<std::uint32_t>(half), source);
}

double TriangleBvh::distance(const glm::vec3& point) const {
  double best = std::numeric_limits<double>::infinity();
  std::array<std::uint32_t, 128> stack;  // depth is at most log2(2^32) with one sibling each
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    if (static_cast<double>(squaredDistanceToBox(point, node.min, node.max)) * 0.99999 >= best) continue;
    if (node.count > 0) {
      for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
        best = std::min(best, squaredDistanceToTriangle(point, triangles_[t].a, triangles_[t].b, triangles_[t].c));
      continue;
    }
    const std::uint32_t left = index + 1;
    const std::uint32_t right = node.first;
    const bool leftFirst = squaredDistanceToBox(point, nodes_[left].min, nodes_[left].max) <=
                           squaredDistanceToBox(point, nodes_[right].min, nodes_[right].max);
    stack[size++] = leftFirst ? right : left;
    stack[size++] = leftFirst ? left : right;
  }
  return std::sqrt(best);
}

}  // namespace jalousie::bake
