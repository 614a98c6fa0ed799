// Accumulates and merges quadrics.
#include "bake/simplify/collapse_error.h"

#include <algorithm>
#include <cmath>

namespace jalousie::bake {
namespace {

/// Weight of the distance to a triangle's centre, as a share of its area: fixes positions that planes alone leave free.
constexpr double kCentrePull = 1e-6;
constexpr double kBorderWeight = 10.0;
constexpr double kSeamWeight = 1.0;
/// An attribute's gradient across a sliver is damped below this share of the sliver's length.
constexpr double kSliver = 0.01;
constexpr std::size_t kMostWeighted = 24;

struct Frame {
  glm::dvec3 normal{0.0};
  double area = 0.0;
};

Frame frameOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double length = glm::length(cross);
  return {length > 0.0 ? cross / length : glm::dvec3(0.0), 0.5 * length};
}

/// In-plane least-squares gradients of functions given at the corners.
class GradientSolver {
 public:
  GradientSolver(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    centre_ = (a + b + c) / 3.0;
    const std::array<glm::dvec3, 3> offsets = {a - centre_, b - centre_, c - centre_};
    const glm::dvec3 edge = b - a;
    const double length = glm::length(edge);
    x_ = length > 0.0 ? edge / length : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 rest = offsets[2] - glm::dot(offsets[2], x_) * x_;
    const double height = glm::length(rest);
    y_ = height > 0.0 ? rest / height : glm::dvec3(0.0);
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      flat_[k] = {glm::dot(offsets[k], x_), glm::dot(offsets[k], y_)};
      xx += flat_[k].x * flat_[k].x;
      xy += flat_[k].x * flat_[k].y;
      yy += flat_[k].y * flat_[k].y;
    }
    const double damping = kSliver * (xx + yy);
    xx += damping;
    yy += damping;
    const double determinant = xx * yy - xy * xy;
    const double scale = determinant > 0.0 ? 1.0 / determinant : 0.0;
    inverse_ = {yy * scale, -xy * scale, xx * scale};
  }

  /// g and d of g.p + d for the values at a, b, c.
  std::pair<glm::dvec3, double> solve(double sa, double sb, double sc) const {
    const double mean = (sa + sb + sc) / 3.0;
    const glm::dvec2 rhs = (sa - mean) * flat_[0] + (sb - mean) * flat_[1] + (sc - mean) * flat_[2];
    const glm::dvec3 g =
        (inverse_.x * rhs.x + inverse_.y * rhs.y) * x_ + (inverse_.y * rhs.x + inverse_.z * rhs.y) * y_;
    return {g, mean - glm::dot(g, centre_)};
  }

 private:
  glm::dvec3 centre_, x_, y_;
  std::array<glm::dvec2, 3> flat_;
  glm::dvec3 inverse_;  ///< xx, xy, yy
};

/// Mean edge length, unit frame.
double meanEdge(const WedgeMesh& mesh, std::span<const glm::dvec3> positions) {
  double sum = 0.0;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    sum +=
        glm::distance(positions[mesh.vertexAt(c)], positions[mesh.vertexAt(nextCorner(static_cast<std::uint32_t>(c)))]);
  return sum / static_cast<double>(std::max<std::size_t>(mesh.corners.size(), 1));
}

/// 1 if all triangles are equilateral, near 0 if all are needles: the mean side of equilateral triangles that have the
/// same ratios of area to perimeter, over the mean edge length.
double fatness(const WedgeMesh& mesh, std::span<const glm::dvec3> positions, double edge) {
  double sum = 0.0;
  for (std::size_t c = 0; c + 2 < mesh.corners.size(); c += 3) {
    const glm::dvec3& a = positions[mesh.vertexAt(c)];
    const glm::dvec3& b = positions[mesh.vertexAt(c + 1)];
    const glm::dvec3& d = positions[mesh.vertexAt(c + 2)];
    const double perimeter = glm::distance(a, b) + glm::distance(b, d) + glm::distance(d, a);
    if (perimeter > 0.0) sum += 4.0 * std::sqrt(3.0) * frameOf(a, b, d).area / perimeter;
  }
  const double most = edge * static_cast<double>(mesh.corners.size() / 3);
  return most > 0.0 ? sum / most : 1.0;
}

/// Length on the surface of one unit of texture space, both as the root of an area; 0 if nothing is mapped.
double lengthPerUv(const WedgeMesh& mesh, const AttributeSlot& slot, std::span<const glm::dvec3> positions) {
  double surface = 0.0;
  double texture = 0.0;
  for (std::size_t c = 0; c + 2 < mesh.corners.size(); c += 3) {
    surface +=
        frameOf(positions[mesh.vertexAt(c)], positions[mesh.vertexAt(c + 1)], positions[mesh.vertexAt(c + 2)]).area;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const float* value = &mesh.attributes[std::size_t{mesh.corners[c + k]} * mesh.stride + slot.offset];
      uv[k] = {value[0], value[1]};
    }
    const glm::dvec2 e = uv[1] - uv[0];
    const glm::dvec2 f = uv[2] - uv[0];
    texture += 0.5 * std::abs(e.x * f.y - e.y * f.x);
  }
  return texture > 1e-12 && std::isfinite(texture) ? std::sqrt(surface / texture) : 0.0;
}

}  // namespace

CollapseError::CollapseError(const WedgeMesh& mesh, const EdgeTable& edges, const CollapseOptions& options,
                             std::span<const glm::dvec3> unitPositions)
    : stride_(mesh.stride), attributes_(mesh.attributes), quadrics_(mesh.positions.size()) {
  chooseWeights(mesh, options, unitPositions);
  addTriangles(mesh, unitPositions);
  addEdges(mesh, edges, unitPositions);
}

void CollapseError::chooseWeights(const WedgeMesh& mesh, const CollapseOptions& options,
                                  std::span<const glm::dvec3> positions) {
  constexpr double kUv = 0.1;       // of the distance by which the texture slides
  constexpr double kColor = 0.005;  // per unit of linear colour
  // Weight of a normal deviation of one radian against a distance. On a fine mesh the levels and their errors are small
  // too: the square root of the edge length balances both from the bunny (1/53) to the dragon (1/800).
  constexpr double kNormal = 0.15;
  // Edges of needles are far longer than what a collapse moves: in a long tube, a bend between two strips would count
  // more than the thickness of the wall, and the wall would be closed. Only meshes of needles reach this limit.
  constexpr double kNeedles = 6.0;
  const double edge = meanEdge(mesh, positions);
  const double normalWeight = kNormal * std::sqrt(edge) * std::min(1.0, kNeedles * fatness(mesh, positions, edge));
  for (const AttributeSlot& slot : mesh.slots) {
    double weight = 0.0;
    if (slot.kind == AttributeKind::kNormal) weight = normalWeight * options.normalWeight.value_or(1.0);
    if (slot.kind == AttributeKind::kUv && options.uvWeight > 0.0)
      weight = kUv * options.uvWeight * lengthPerUv(mesh, slot, positions);
    if (slot.kind == AttributeKind::kColor) weight = kColor * options.colorWeight;
    if (!(weight > 0.0) || weights_.size() + slot.components > kMostWeighted) continue;
    for (std::uint32_t k = 0; k < slot.components; ++k)
      weights_.push_back({slot.offset + k, weight, slot.kind != AttributeKind::kNormal});
  }
}

void CollapseError::addTriangles(const WedgeMesh& mesh, std::span<const glm::dvec3> positions) {
  const std::size_t weighted = weights_.size();
  linear_.resize(mesh.vertexOf.size() * weighted);
  areas_.assign(mesh.vertexOf.size(), 0.0);
  for (std::size_t c = 0; c + 2 < mesh.corners.size(); c += 3) {
    const glm::dvec3& p0 = positions[mesh.vertexAt(c)];
    const glm::dvec3& p1 = positions[mesh.vertexAt(c + 1)];
    const glm::dvec3& p2 = positions[mesh.vertexAt(c + 2)];
    const Frame frame = frameOf(p0, p1, p2);
    Quadric quadric;
    quadric.addPlane(frame.normal, -glm::dot(frame.normal, p0), frame.area);
    quadric.addPoint((p0 + p1 + p2) / 3.0, kCentrePull * frame.area);
    const std::array<std::uint32_t, 3> wedges = {mesh.corners[c], mesh.corners[c + 1], mesh.corners[c + 2]};
    if (weighted > 0) {
      const GradientSolver gradients(p0, p1, p2);
      for (std::size_t k = 0; k < weighted; ++k) {
        std::array<double, 3> s;
        for (std::size_t i = 0; i < 3; ++i)
          s[i] = weights_[k].weight * attributes(wedges[i])[weights_[k].offset];
        const auto [g, d] = gradients.solve(s[0], s[1], s[2]);
        quadric.addPlane(g, d, frame.area);
        for (const std::uint32_t w : wedges) {
          linear_[w * weighted + k].g += frame.area * g;
          linear_[w * weighted + k].d += frame.area * d;
        }
      }
    }
    for (const std::uint32_t w : wedges) {
      areas_[w] += frame.area;
      quadrics_[mesh.vertexOf[w]] += quadric;
    }
  }
}

void CollapseError::addEdges(const WedgeMesh& mesh, const EdgeTable& edges, std::span<const glm::dvec3> positions) {
  const auto frameAt = [&](std::uint32_t corner) {
    const std::size_t first = corner / 3 * 3;
    return frameOf(positions[mesh.vertexAt(first)], positions[mesh.vertexAt(first + 1)],
                   positions[mesh.vertexAt(first + 2)]);
  };
  for (const MeshEdge& edge : edges.edges) {
    if (edge.kind == EdgeKind::kSmooth) continue;
    double weight = edge.kind == EdgeKind::kBorder ? kBorderWeight : kSeamWeight;
    if (edge.kind == EdgeKind::kHard) {
      // On flat-shaded smooth surfaces every edge is hard: only the bend counts.
      const double bend =
          glm::dot(frameAt(edges.uses[edge.firstUse]).normal, frameAt(edges.uses[edge.firstUse + 1]).normal);
      weight *= 0.5 * (1.0 - bend);
    }
    const glm::dvec3& a = positions[edge.a];
    const glm::dvec3 along = positions[edge.b] - a;
    const double length2 = glm::dot(along, along);
    if (!(length2 > 0.0)) continue;
    for (std::uint32_t use = 0; use < edge.useCount; ++use) {
      const glm::dvec3 across = glm::cross(frameAt(edges.uses[edge.firstUse + use]).normal, along);
      const double acrossLength = glm::length(across);
      if (!(acrossLength > 0.0)) continue;
      const glm::dvec3 normal = across / acrossLength;
      for (const std::uint32_t v : {edge.a, edge.b})
        quadrics_[v].addPlane(normal, -glm::dot(normal, a), weight * length2);
    }
  }
}

void CollapseError::sumGroup(const WedgeMerge& merge, std::size_t group, std::span<Linear> sums, double& area) const {
  const std::size_t weighted = weights_.size();
  std::fill(sums.begin(), sums.end(), Linear());
  area = 0.0;
  for (std::size_t i = 0; i < merge.count; ++i) {
    if (merge.group[i] != group) continue;
    const std::size_t first = merge.wedges[i] * weighted;
    for (std::size_t k = 0; k < weighted; ++k) {
      sums[k].g += linear_[first + k].g;
      sums[k].d += linear_[first + k].d;
    }
    area += areas_[merge.wedges[i]];
  }
}

Quadric CollapseError::merged(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge) const {
  Quadric quadric = quadrics_[u];
  quadric += quadrics_[v];
  std::array<Linear, kMostWeighted> buffer;
  const std::span<Linear> sums(buffer.data(), weights_.size());
  if (sums.empty()) return quadric;
  for (std::size_t group = 0; group < merge.groups; ++group) {
    double area = 0.0;
    sumGroup(merge, group, sums, area);
    if (!(area > 0.0)) continue;
    for (const Linear& sum : sums)
      quadric.addPlane(sum.g, sum.d, -1.0 / area);
  }
  return quadric;
}

void CollapseError::attributesAt(const glm::dvec3& p, double along, const WedgeMerge& merge,
                                 std::vector<float>& values) const {
  values.resize(merge.groups * stride_);
  std::array<Linear, kMostWeighted> buffer;
  const std::span<Linear> sums(buffer.data(), weights_.size());
  for (std::size_t group = 0; group < merge.groups; ++group) {
    const float* fromU = nullptr;
    const float* fromV = nullptr;
    for (std::size_t i = 0; i < merge.count; ++i) {
      if (merge.group[i] != group) continue;
      const float*& side = merge.fromV[i] != 0 ? fromV : fromU;
      if (side == nullptr) side = attributes(merge.wedges[i]);
    }
    float* out = values.data() + group * stride_;
    for (std::uint32_t k = 0; k < stride_; ++k) {
      const double a = fromU != nullptr ? fromU[k] : fromV[k];
      const double b = fromV != nullptr ? fromV[k] : fromU[k];
      out[k] = static_cast<float>(a + along * (b - a));
    }
    double area = 0.0;
    sumGroup(merge, group, sums, area);
    if (!(area > 0.0)) continue;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Weighted& weighted = weights_[k];
      double value = (glm::dot(sums[k].g, p) + sums[k].d) / (area * weighted.weight);
      if (weighted.bounded && fromU != nullptr && fromV != nullptr) {
        const double low = std::min(fromU[weighted.offset], fromV[weighted.offset]);
        const double high = std::max(fromU[weighted.offset], fromV[weighted.offset]);
        const double margin = 0.5 * (high - low);
        value = std::clamp(value, low - margin, high + margin);
      }
      if (std::isfinite(value)) out[weighted.offset] = static_cast<float>(value);
    }
  }
}

void CollapseError::commit(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge,
                           const std::vector<float>& values) {
  quadrics_[u] += quadrics_[v];
  const std::size_t weighted = weights_.size();
  std::array<std::uint32_t, WedgeMerge::kMost> first;
  first.fill(~0U);
  for (std::size_t i = 0; i < merge.count; ++i) {
    const std::uint32_t w = merge.wedges[i];
    std::uint32_t& target = first[merge.group[i]];
    if (target == ~0U) {
      target = w;
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(std::size_t{merge.group[i]} * stride_), stride_,
                  attributes_.begin() + static_cast<std::ptrdiff_t>(std::size_t{w} * stride_));
      continue;
    }
    for (std::size_t k = 0; k < weighted; ++k) {
      linear_[target * weighted + k].g += linear_[w * weighted + k].g;
      linear_[target * weighted + k].d += linear_[w * weighted + k].d;
    }
    areas_[target] += areas_[w];
  }
}

}  // namespace jalousie::bake
