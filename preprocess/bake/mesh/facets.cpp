// Grows flat parts from their largest triangle, then searches a rectangle in each.
#include "bake/mesh/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "bake/mesh/largest_rectangle.h"
#include "core/aabb.h"

namespace jalousie::bake {
namespace {

constexpr double kFlat = 1e-6;         ///< of the diagonal
constexpr double kSameNormal = 0.999;  ///< least cosine
constexpr std::uint32_t kNoFacet = std::numeric_limits<std::uint32_t>::max();

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class FlatParts {
 public:
  FlatParts(const LevelSurface& surface, std::span<const std::uint8_t> bothSides)
      : surface_(surface), bothSides_(bothSides), place_(firstAtPlace(surface)), isTaken_(count(), false) {
    Aabb bounds;
    for (const std::uint32_t index : surface.indices)
      bounds.add(surface.positions[index]);
    diagonal_ = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    for (std::uint32_t t = 0; t < count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto [known, isNew] = triangleAt_.try_emplace(edgeOf(t, k), t);
        if (!isNew) known->second = kNoFacet;  // more than one: no neighbour
      }
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(surface_.indices.size() / 3); }
  double diagonal() const { return diagonal_; }
  bool isTaken(std::uint32_t triangle) const { return isTaken_[triangle]; }
  bool bothSides(std::uint32_t triangle) const { return bothSides_[triangle] != 0; }

  glm::dvec3 corner(std::uint32_t triangle, int k) const {
    return surface_.positions[surface_.indices[3 * std::size_t{triangle} + static_cast<std::size_t>(k)]];
  }
  /// Twice the area long.
  glm::dvec3 normal(std::uint32_t t) const {
    return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  }

  /// All triangles in the plane of the first that are connected with it; they are taken.
  std::vector<std::uint32_t> grow(std::uint32_t first) {
    const glm::dvec3 direction = glm::normalize(normal(first));
    const glm::dvec3 on = corner(first, 0);
    std::vector<std::uint32_t> part = {first};
    isTaken_[first] = true;
    for (std::size_t next = 0; next < part.size(); ++next) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t beside = neighbour(part[next], k);
        if (beside == kNoFacet || isTaken_[beside] || bothSides(beside) != bothSides(first)) continue;
        if (!liesIn(beside, direction, on)) continue;
        isTaken_[beside] = true;
        part.push_back(beside);
      }
    }
    return part;
  }

  /// The triangle on the other side of an edge; kNoFacet: none, or several.
  std::uint32_t neighbour(std::uint32_t triangle, int k) const {
    const Edge edge = edgeOf(triangle, k);
    if (triangleAt_.at(edge) == kNoFacet) return kNoFacet;
    const auto found = triangleAt_.find({edge.second, edge.first});
    return found == triangleAt_.end() ? kNoFacet : found->second;
  }

 private:
  Edge edgeOf(std::uint32_t triangle, int k) const {
    const std::size_t first = 3 * std::size_t{triangle};
    return {place_[surface_.indices[first + static_cast<std::size_t>(k)]],
            place_[surface_.indices[first + static_cast<std::size_t>((k + 1) % 3)]]};
  }

  bool liesIn(std::uint32_t triangle, const glm::dvec3& direction, const glm::dvec3& on) const {
    const glm::dvec3 own = normal(triangle);
    if (!(glm::dot(own, direction) >= kSameNormal * glm::length(own))) return false;
    for (int k = 0; k < 3; ++k)
      if (std::abs(glm::dot(corner(triangle, k) - on, direction)) > kFlat * diagonal_) return false;
    return true;
  }

  const LevelSurface& surface_;
  std::span<const std::uint8_t> bothSides_;
  std::vector<std::uint32_t> place_;
  std::map<Edge, std::uint32_t> triangleAt_;
  std::vector<bool> isTaken_;
  double diagonal_ = 0.0;
};

/// A frame on a flat part: x along its longest border, z out of it.
struct Frame {
  glm::dvec3 origin;
  glm::dvec3 x;
  glm::dvec3 y;
  glm::dvec3 z;
  glm::dvec3 toLocal(const glm::dvec3& p) const {
    return {glm::dot(p - origin, x), glm::dot(p - origin, y), glm::dot(p - origin, z)};
  }
};

/// Ends of the edges of a part that no other triangle of it has.
std::vector<std::pair<glm::dvec3, glm::dvec3>> borderOf(const FlatParts& parts,
                                                        const std::vector<std::uint32_t>& part) {
  std::vector<bool> isIn(parts.count(), false);
  for (const std::uint32_t triangle : part)
    isIn[triangle] = true;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> border;
  for (const std::uint32_t triangle : part)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t beside = parts.neighbour(triangle, k);
      if (beside == kNoFacet || !isIn[beside])
        border.emplace_back(parts.corner(triangle, k), parts.corner(triangle, (k + 1) % 3));
    }
  return border;
}

bool holds(const glm::dvec3 (&t)[3], const glm::dvec2& p) {
  for (int k = 0; k < 3; ++k) {
    const glm::dvec2 from(t[k]);
    const glm::dvec2 edge = glm::dvec2(t[(k + 1) % 3]) - from;
    if (edge.x * (p.y - from.y) - edge.y * (p.x - from.x) < 0.0) return false;
  }
  return true;
}

/// Cells over a flat part.
class PartGrid {
 public:
  PartGrid(const FlatParts& parts, const std::vector<std::uint32_t>& part, std::uint32_t cells)
      : cells_(cells), isFree_(std::size_t{cells} * cells, 0) {
    const auto border = borderOf(parts, part);
    if (border.empty()) return;
    const auto length = [](const auto& edge) { return glm::length(edge.second - edge.first); };
    const auto longest = std::max_element(border.begin(), border.end(),
                                          [&](const auto& a, const auto& b) { return length(a) < length(b); });
    frame_.origin = longest->first;
    frame_.z = glm::normalize(parts.normal(part[0]));
    frame_.x = glm::normalize(longest->second - longest->first);
    frame_.y = glm::cross(frame_.z, frame_.x);
    measure(border);
    for (const std::uint32_t triangle : part)
      cover(parts, triangle);
    for (const auto& [from, to] : border)
      mark(frame_.toLocal(from), frame_.toLocal(to));
  }

  std::optional<Facet> largest() const {
    const CellRectangle found = largestRectangle(isFree_, cells_);
    if (found.area() == 0) return std::nullopt;
    const glm::dvec2 low = low_ + glm::dvec2(found.low) * cell_;
    const glm::dvec2 high = low_ + glm::dvec2(found.high) * cell_;
    const auto at = [&](double x, double y) { return glm::vec3(frame_.origin + x * frame_.x + y * frame_.y); };
    Facet facet;
    facet.corners = {at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
    facet.area = (high.x - low.x) * (high.y - low.y);
    return facet;
  }

 private:
  void measure(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& border) {
    low_ = glm::dvec2(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (const auto& edge : border) {
      low_ = glm::min(low_, glm::dvec2(frame_.toLocal(edge.first)));
      high = glm::max(high, glm::dvec2(frame_.toLocal(edge.first)));
    }
    cell_ = (high - low_) / static_cast<double>(cells_);
  }

  /// Calls visit(cell, middle) for the cells that a box around some points covers.
  template <class Visit>
  void forEach(const glm::dvec2& low, const glm::dvec2& high, const Visit& visit) {
    const auto cellOf = [&](const glm::dvec2& p, int beyond) {
      const glm::dvec2 at = glm::floor((p - low_) / cell_) + static_cast<double>(beyond);
      return glm::uvec2(glm::clamp(at, glm::dvec2(0.0), glm::dvec2(cells_ - 1U)));
    };
    const glm::uvec2 first = cellOf(low, -1);
    const glm::uvec2 last = cellOf(high, 1);
    for (std::uint32_t y = first.y; y <= last.y; ++y)
      for (std::uint32_t x = first.x; x <= last.x; ++x)
        visit(isFree_[std::size_t{y} * cells_ + x], low_ + (glm::dvec2(x, y) + 0.5) * cell_);
  }

  void cover(const FlatParts& parts, std::uint32_t triangle) {
    const glm::dvec3 t[3] = {frame_.toLocal(parts.corner(triangle, 0)), frame_.toLocal(parts.corner(triangle, 1)),
                             frame_.toLocal(parts.corner(triangle, 2))};
    forEach(glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2]),
            [&](std::uint8_t& cell, const glm::dvec2& middle) {
              if (holds(t, middle)) cell = 1;
            });
  }

  void mark(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 segment[3] = {from, to, to};
    const double thick = glm::length(cell_);
    forEach(glm::min(from, to), glm::max(from, to), [&](std::uint8_t& cell, const glm::dvec2& middle) {
      if (touches(segment, glm::dvec3(middle, 0.0), glm::dvec3(0.501 * cell_, thick))) cell = 0;
    });
  }

  std::uint32_t cells_;
  std::vector<std::uint8_t> isFree_;
  Frame frame_{};
  glm::dvec2 low_{0.0};
  glm::dvec2 cell_{0.0};
};

}  // namespace

std::vector<Facet> largeFacets(const LevelSurface& surface, std::span<const std::uint8_t> drawnFromBothSides,
                               const FacetOptions& options) {
  FlatParts parts(surface, drawnFromBothSides);
  const double least = options.least * parts.diagonal() * parts.diagonal();
  std::vector<std::pair<double, std::uint32_t>> seeds;  // area, falling
  for (std::uint32_t t = 0; t < parts.count(); ++t)
    seeds.emplace_back(-0.5 * glm::length(parts.normal(t)), t);
  std::sort(seeds.begin(), seeds.end());
  std::vector<Facet> facets;
  for (const auto& [negative, triangle] : seeds) {
    if (parts.isTaken(triangle) || !(negative < 0.0)) continue;
    const std::vector<std::uint32_t> part = parts.grow(triangle);
    const double area = std::accumulate(part.begin(), part.end(), 0.0, [&](double sum, std::uint32_t t) {
      return sum + 0.5 * glm::length(parts.normal(t));
    });
    if (area < least) continue;
    std::optional<Facet> facet = PartGrid(parts, part, options.cells).largest();
    if (!facet || facet->area < least) continue;
    facet->bothSides = parts.bothSides(triangle);
    facets.push_back(*facet);
  }
  std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.area > b.area; });
  if (facets.size() > options.facets) facets.resize(options.facets);
  return facets;
}

}  // namespace jalousie::bake
