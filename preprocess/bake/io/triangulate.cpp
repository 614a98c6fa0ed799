// Ear clipping of simple polygons, in double precision.
#include "bake/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace jalousie::bake {
namespace {

/// Newell's sum: twice the area of the polygon along its mean normal.
glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - polygon[0];
    const glm::dvec3 b = polygon[(i + 1) % polygon.size()] - polygon[0];
    sum += glm::cross(a, b);
  }
  return sum;
}

/// The polygon without the axis along which its normal is longest, counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  std::vector<glm::dvec2> flat;
  flat.reserve(polygon.size());
  for (const glm::dvec3& p : polygon)
    flat.emplace_back(p[u] - polygon[0][u], p[v] - polygon[0][v]);
  return flat;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<glm::dvec2> points) : points_(std::move(points)), left_(points_.size()) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    next_.resize(n);
    previous_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
  }

  bool isConvex() const {
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (turnAt(i) < 0.0) return false;
    return true;
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * (points_.size() - 2));
    std::uint32_t at = 0;
    std::size_t passed = 0;
    while (left_ > 3) {
      // A polygon that crosses itself may have no ear; then any corner is cut off.
      if (!isEar(at) && passed < left_) {
        at = next_[at];
        ++passed;
        continue;
      }
      triangles.insert(triangles.end(), {previous_[at], at, next_[at]});
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      at = next_[next_[at]];  // the neighbours of an ear would make a thin fan
      --left_;
      passed = 0;
    }
    triangles.insert(triangles.end(), {previous_[at], at, next_[at]});
    return triangles;
  }

 private:
  double turnAt(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }

  bool isEar(std::uint32_t i) const {
    const glm::dvec2& a = points_[previous_[i]];
    const glm::dvec2& b = points_[i];
    const glm::dvec2& c = points_[next_[i]];
    if (turn(a, b, c) <= 0.0) return false;
    for (std::uint32_t k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
      const glm::dvec2& p = points_[k];
      if (p == a || p == b || p == c) continue;  // where a hole is joined to its outline
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  std::vector<glm::dvec2> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::size_t left_;
};

std::vector<std::uint32_t> fan(std::size_t corners) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 2; i < corners; ++i)
    triangles.insert(triangles.end(), {0U, i - 1, i});
  return triangles;
}

}  // namespace

std::vector<std::uint32_t> triangulate(std::span<const glm::dvec3> polygon) {
  if (polygon.size() <= 3) return fan(polygon.size());
  const glm::dvec3 normal = newellNormal(polygon);
  if (!(glm::dot(normal, normal) > 0.0)) return fan(polygon.size());
  EarClipper clipper(flattened(polygon, normal));
  return clipper.isConvex() ? fan(polygon.size()) : clipper.run();
}

}  // namespace jalousie::bake
