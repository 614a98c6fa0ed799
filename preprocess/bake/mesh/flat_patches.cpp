// Grows patches over shared edges; a piece lies in a patch if no side of the patch crosses its inside.
#include "bake/mesh/flat_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace jalousie::bake {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct HalfEdge {
  std::uint32_t low, high;  ///< vertices
  std::uint32_t triangle;

  friend bool operator<(const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  }
  bool sameEdge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

/// All edges of all triangles, sorted, so that those of one edge are neighbours.
std::vector<HalfEdge> sortedEdges(std::span<const std::uint32_t> indices) {
  std::vector<HalfEdge> edges;
  edges.reserve(indices.size());
  for (std::size_t c = 0; c < indices.size(); ++c) {
    const std::uint32_t a = indices[c];
    const std::uint32_t b = indices[c / 3 * 3 + (c + 1) % 3];
    edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(c / 3)});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// What a triangle shares its edges with.
class Neighbours {
 public:
  explicit Neighbours(std::span<const std::uint32_t> indices) : indices_(indices), edges_(sortedEdges(indices)) {}

  /// All triangles at an edge of a triangle, itself included.
  std::span<const HalfEdge> atEdge(std::uint32_t triangle, std::size_t k) const {
    const std::uint32_t a = indices_[3 * std::size_t{triangle} + k];
    const std::uint32_t b = indices_[3 * std::size_t{triangle} + (k + 1) % 3];
    const HalfEdge first{std::min(a, b), std::max(a, b), 0};
    const auto begin = std::lower_bound(edges_.begin(), edges_.end(), first);
    auto end = begin;
    while (end != edges_.end() && end->sameEdge(first))
      ++end;
    return {begin, end};
  }

 private:
  std::span<const std::uint32_t> indices_;
  std::vector<HalfEdge> edges_;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// A triangle in the plane of a patch, counter-clockwise.
struct Piece {
  std::array<glm::dvec2, 3> corners;
  double longest = 0.0;
  double inradius = 0.0;
};

Piece pieceOf(std::array<glm::dvec2, 3> corners) {
  double area2 = cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (area2 < 0.0) std::swap(corners[1], corners[2]), area2 = -area2;
  Piece piece{corners, 0.0, 0.0};
  double perimeter = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = glm::distance(corners[k], corners[(k + 1) % 3]);
    piece.longest = std::max(piece.longest, length);
    perimeter += length;
  }
  piece.inradius = perimeter > 0.0 ? area2 / perimeter : 0.0;
  return piece;
}

/// Whether a segment comes further than `margin` into a piece.
bool crosses(const Piece& piece, const glm::dvec2& a, const glm::dvec2& b, double margin) {
  double from = 0.0;
  double to = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = piece.corners[(k + 1) % 3] - piece.corners[k];
    const double least = margin * glm::length(side);
    const double atA = cross(side, a - piece.corners[k]) - least;
    const double atB = cross(side, b - piece.corners[k]) - least;
    if (atA <= 0.0 && atB <= 0.0) return false;
    if (atA < 0.0) from = std::max(from, atA / (atA - atB));
    if (atB < 0.0) to = std::min(to, atA / (atA - atB));
  }
  return from < to;
}

}  // namespace

/// Grows the patches of a mesh one after the other.
class FlatPatches::Builder {
 public:
  Builder(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, FlatPatches& patches)
      : positions_(positions), indices_(indices), neighbours_(indices), out_(patches), isSeen_(indices.size() / 3, 0) {}

  void add(std::uint32_t seed) {
    const glm::dvec3 normal = crossOf(seed);
    const double length = glm::length(normal);
    if (isSeen_[seed] != 0 || !(length > 0.0) || !std::isfinite(length)) return;
    const glm::dvec3 u = glm::normalize(corner(seed, 1) - corner(seed, 0));
    Patch patch{corner(seed, 0), u, glm::cross(normal / length, u), normal / length, out_.sides_.size(), 0};
    const auto number = static_cast<std::uint32_t>(out_.patches_.size());
    grow(patch, seed, number);
    addSides(patch, number);
    if (members_.size() >= 2 && patch.sideCount <= kMostSides) {
      out_.patches_.push_back(patch);
      return;
    }
    out_.sides_.resize(patch.firstSide);
    for (const std::uint32_t t : members_)
      out_.patchOf_[t] = kNone;
  }

 private:
  glm::dvec3 corner(std::uint32_t t, std::size_t k) const {
    return glm::dvec3(positions_[indices_[3 * std::size_t{t} + k]]);
  }
  glm::dvec3 crossOf(std::uint32_t t) const {
    return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  }

  bool liesIn(const Patch& patch, std::uint32_t t) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(glm::dot(corner(t, k) - patch.origin, patch.normal)) <= out_.rounding_)) return false;
    return glm::dot(crossOf(t), patch.normal) > 0.0;
  }

  void grow(const Patch& patch, std::uint32_t seed, std::uint32_t number) {
    const auto take = [&](std::uint32_t t) {
      isSeen_[t] = 1;
      out_.patchOf_[t] = number;
      members_.push_back(t);
    };
    members_.clear();
    take(seed);
    for (std::size_t m = 0; m < members_.size(); ++m) {
      for (std::size_t k = 0; k < 3; ++k)
        for (const HalfEdge& other : neighbours_.atEdge(members_[m], k))
          if (isSeen_[other.triangle] == 0 && liesIn(patch, other.triangle)) take(other.triangle);
    }
  }

  void addSides(Patch& patch, std::uint32_t number) {
    const auto planar = [&](const glm::dvec3& p) {
      return glm::dvec2(glm::dot(p - patch.origin, patch.u), glm::dot(p - patch.origin, patch.v));
    };
    for (const std::uint32_t t : members_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::span<const HalfEdge> around = neighbours_.atEdge(t, k);
        const auto inside = std::count_if(around.begin(), around.end(),
                                          [&](const HalfEdge& edge) { return out_.patchOf_[edge.triangle] == number; });
        if (inside % 2 != 0) out_.sides_.push_back({planar(corner(t, k)), planar(corner(t, (k + 1) % 3))});
      }
    }
    patch.sideCount = out_.sides_.size() - patch.firstSide;
  }

  std::span<const glm::vec3> positions_;
  std::span<const std::uint32_t> indices_;
  Neighbours neighbours_;
  FlatPatches& out_;
  std::vector<std::uint8_t> isSeen_;
  std::vector<std::uint32_t> members_;  ///< of the patch that grows
};

FlatPatches::FlatPatches(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, double rounding)
    : rounding_(rounding), patchOf_(indices.size() / 3, kNone) {
  Builder builder(positions, indices, *this);
  for (std::uint32_t t = 0; t < patchOf_.size(); ++t)
    builder.add(t);
}

/// By the number of sides that a ray crosses.
bool FlatPatches::holds(const Patch& patch, const glm::dvec2& point) const {
  bool isInside = false;
  for (std::size_t s = patch.firstSide; s < patch.firstSide + patch.sideCount; ++s) {
    const auto& [a, b] = sides_[s];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) isInside = !isInside;
  }
  return isInside;
}

double FlatPatches::bound(std::uint32_t triangle, const std::array<glm::vec3, 3>& piece) const {
  if (patchOf_[triangle] == kNone) return kInfinity;
  const Patch& patch = patches_[patchOf_[triangle]];
  double height = 0.0;
  std::array<glm::dvec2, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 off = glm::dvec3(piece[k]) - patch.origin;
    height = std::max(height, std::abs(glm::dot(off, patch.normal)));
    corners[k] = {glm::dot(off, patch.u), glm::dot(off, patch.v)};
  }
  const Piece planar = pieceOf(corners);
  // What is cut off at the rim, `rounding` wide, moves the corners by this much towards the centre of the incircle.
  const double moved = rounding_ * planar.longest / planar.inradius;
  if (!(planar.inradius > 2.0 * rounding_)) return kInfinity;
  for (std::size_t s = patch.firstSide; s < patch.firstSide + patch.sideCount; ++s)
    if (crosses(planar, sides_[s].a, sides_[s].b, rounding_)) return kInfinity;
  const glm::dvec2 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  return holds(patch, centre) ? height + rounding_ + moved : kInfinity;
}

}  // namespace jalousie::bake
