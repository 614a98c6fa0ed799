// The triangles at each vertex while edges are collapsed. Non-manifold edges and vertices are allowed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Corner lists per vertex as linked lists in flat arrays: two vertices are merged in constant time, and dead corners
/// are removed during iteration. A corner is 3 * face + k. The arrays are plain, so that the hot checks are inlined.
class CollapseTopology {
 public:
  static constexpr std::uint32_t kNone = ~0U;

  /// @param vertices  of each corner, in threes   @param wedges  likewise
  CollapseTopology(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> wedges,
                   std::size_t vertexCount);

  std::uint32_t faces() const { return aliveFaces_; }
  bool isAlive(std::uint32_t face) const { return vertexAt_[std::size_t{3} * face] != kNone; }
  std::uint32_t vertexAt(std::uint32_t corner) const { return vertexAt_[corner]; }
  std::uint32_t wedgeAt(std::uint32_t corner) const { return wedgeAt_[corner]; }
  void setWedge(std::uint32_t corner, std::uint32_t wedge) { wedgeAt_[corner] = wedge; }
  /// The two other corners of a corner's face, in winding order.
  static std::array<std::uint32_t, 2> others(std::uint32_t corner) {
    const std::uint32_t first = corner / 3 * 3;
    const std::uint32_t k = corner - first;
    return {first + (k + 1) % 3, first + (k + 2) % 3};
  }

  /// Calls visit(corner) for every live corner at v, dropping dead ones from the list.
  template <class Visit>
  void forEachCorner(std::uint32_t v, const Visit& visit) {
    std::uint32_t* link = &head_[v];
    std::uint32_t last = kNone;
    while (*link != kNone) {
      const std::uint32_t corner = *link;
      if (vertexAt_[corner] == kNone) {
        *link = next_[corner];
        continue;
      }
      visit(corner);
      last = corner;
      link = &next_[corner];
    }
    tail_[v] = last;
  }

  /// Whether edge uv may be collapsed: the vertices adjacent to both ends are exactly those opposite the edge (link
  /// condition), two sheets are not folded onto each other, and a border stays a border.
  bool canCollapse(std::uint32_t u, std::uint32_t v, bool bothOnBorder);
  /// Faces at edge uv.
  std::uint32_t sharedFaces(std::uint32_t u, std::uint32_t v) {
    std::uint32_t shared = 0;
    forEachCorner(u, [&](std::uint32_t corner) {
      const auto [a, b] = others(corner);
      shared += vertexAt_[a] == v || vertexAt_[b] == v ? 1U : 0U;
    });
    return shared;
  }
  /// Removes a face.
  void remove(std::uint32_t face);
  /// Moves every live corner of v to u. @pre the faces of both were removed
  void merge(std::uint32_t u, std::uint32_t v);

 private:
  std::vector<std::uint32_t> vertexAt_, wedgeAt_, next_, head_, tail_;
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0;
  std::uint32_t aliveFaces_ = 0;
};

}  // namespace jalousie::bake
