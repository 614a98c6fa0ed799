// Around each position, triangles that share an edge without a crease form fans; each fan has one normal.
#include "bake/io/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/mesh/union_find.h"

namespace jalousie::bake {
namespace {

/// Equal positions have one number, so that corners of meshes without shared vertices meet.
std::vector<std::uint32_t> numberPositions(const std::vector<glm::dvec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec3& p = positions[a];
    const glm::dvec3& q = positions[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> numbers(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    numbers[order[i]] = i > 0 && positions[order[i]] == positions[order[i - 1]] ? numbers[order[i - 1]] : order[i];
  return numbers;
}

class CreaseNormals {
 public:
  CreaseNormals(const PolygonMesh& mesh, std::span<const std::uint32_t> corners, std::span<const std::uint32_t> faces)
      : mesh_(mesh), corners_(corners), faces_(faces), numbers_(numberPositions(mesh.positions)) {
    for (std::size_t t = 0; t < faces.size(); ++t) {
      const glm::dvec3 cross = glm::cross(at(3 * t + 1) - at(3 * t), at(3 * t + 2) - at(3 * t));
      const double length = glm::length(cross);
      flat_.push_back(length > 0.0 ? cross / length : glm::dvec3(0.0));
    }
    fans_ = UnionFind(corners.size());
    joinFans();
  }

  /// @param given  per corner of the triangles the number of its normal, or kNoIndex, which is replaced
  void fill(CornerNormals& given) {
    std::vector<std::uint32_t> normalOf(corners_.size(), kNoIndex);
    std::vector<glm::dvec3> sums(corners_.size(), glm::dvec3(0.0));
    for (std::uint32_t c = 0; c < corners_.size(); ++c)
      sums[fans_.rootOf(c)] += angle(c) * flat_[c / 3];
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      if (given.ofCorner[c] != kNoIndex) continue;
      const std::uint32_t fan = fans_.rootOf(c);
      if (normalOf[fan] == kNoIndex) {
        const double length = glm::length(sums[fan]);
        normalOf[fan] = static_cast<std::uint32_t>(given.values.size());
        given.values.emplace_back(length > 1e-12 ? sums[fan] / length : glm::dvec3(0.0, 1.0, 0.0));
      }
      given.ofCorner[c] = normalOf[fan];
    }
  }

 private:
  const glm::dvec3& at(std::size_t c) const { return mesh_.positions[mesh_.corners[corners_[c]].position]; }
  std::uint32_t number(std::size_t c) const { return numbers_[mesh_.corners[corners_[c]].position]; }
  static std::uint32_t next(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }

  double angle(std::uint32_t c) const {
    const glm::dvec3 a = at(next(c)) - at(c);
    const glm::dvec3 b = at(next(next(c))) - at(c);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }

  bool isSmooth(std::uint32_t t, std::uint32_t u) const {
    if (faces_[t] == faces_[u]) return true;
    const PolygonMesh::Face& a = mesh_.faces[faces_[t]];
    const PolygonMesh::Face& b = mesh_.faces[faces_[u]];
    if (a.object != b.object) return false;
    if (mesh_.hasSmoothing) return a.smoothing != 0 && a.smoothing == b.smoothing;
    static const double kLeast = std::cos(kCreaseDegrees * 3.14159265358979323846 / 180.0);
    return glm::dot(flat_[t], flat_[u]) >= kLeast;
  }

  /// Joins the corners of two triangles at both ends of an edge that they share.
  void joinFans() {
    struct Side {
      std::uint32_t low, high, corner;
    };
    std::vector<Side> sides;
    sides.reserve(corners_.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const std::uint32_t a = number(c);
      const std::uint32_t b = number(next(c));
      sides.push_back({std::min(a, b), std::max(a, b), c});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const Side& a = sides[i - 1];
      const Side& b = sides[i];
      if (a.low != b.low || a.high != b.high || !isSmooth(a.corner / 3, b.corner / 3)) continue;
      const bool sameWay = number(a.corner) == number(b.corner);
      fans_.unite(a.corner, sameWay ? b.corner : next(b.corner));
      fans_.unite(next(a.corner), sameWay ? next(b.corner) : b.corner);
    }
  }

  const PolygonMesh& mesh_;
  std::span<const std::uint32_t> corners_;
  std::span<const std::uint32_t> faces_;
  std::vector<std::uint32_t> numbers_;
  std::vector<glm::dvec3> flat_;
  UnionFind fans_{0};
};

}  // namespace

CornerNormals cornerNormals(const PolygonMesh& mesh, std::span<const std::uint32_t> corners,
                            std::span<const std::uint32_t> faces, NormalRule rule) {
  CornerNormals normals;
  normals.values.reserve(mesh.normals.size());
  std::vector<bool> hasLength;
  for (const glm::vec3& n : mesh.normals) {
    hasLength.push_back(glm::dot(n, n) > 1e-8F);
    normals.values.push_back(hasLength.back() ? glm::normalize(n) : glm::vec3(0.0F, 1.0F, 0.0F));
  }
  bool isComplete = true;
  for (const std::uint32_t corner : corners) {
    const std::uint32_t given = mesh.corners[corner].normal;
    normals.ofCorner.push_back(given != kNoIndex && hasLength[given] ? given : kNoIndex);
    isComplete = isComplete && normals.ofCorner.back() != kNoIndex;
  }
  if (!isComplete && rule == NormalRule::kCreases) CreaseNormals(mesh, corners, faces).fill(normals);
  return normals;
}

}  // namespace jalousie::bake
