// Builds and merges the corner lists, and checks whether a collapse is legal.
#include "bake/simplify/collapse_topology.h"

#include <algorithm>

namespace jalousie::bake {

CollapseTopology::CollapseTopology(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> wedges,
                                   std::size_t vertexCount)
    : vertexAt_(vertices.begin(), vertices.end()),
      wedgeAt_(wedges.begin(), wedges.end()),
      next_(vertices.size(), kNone),
      head_(vertexCount, kNone),
      tail_(vertexCount, kNone),
      mark_(vertexCount, 0),
      aliveFaces_(static_cast<std::uint32_t>(vertices.size() / 3)) {
  for (std::uint32_t corner = 0; corner < vertexAt_.size(); ++corner) {
    const std::uint32_t v = vertexAt_[corner];
    if (head_[v] == kNone) {
      head_[v] = corner;
    } else {
      next_[tail_[v]] = corner;
    }
    tail_[v] = corner;
  }
}

bool CollapseTopology::canCollapse(std::uint32_t u, std::uint32_t v, bool bothOnBorder) {
  // Marks: base + 1 next to u, + 2 opposite the edge, + 3 next to both.
  if (stamp_ > ~0U - 8U) {
    std::fill(mark_.begin(), mark_.end(), 0);
    stamp_ = 0;
  }
  const std::uint32_t base = stamp_;
  stamp_ += 4;
  std::uint32_t shared = 0;
  forEachCorner(u, [&](std::uint32_t corner) {
    for (const std::uint32_t other : others(corner)) {
      std::uint32_t& mark = mark_[vertexAt_[other]];
      if (mark <= base) mark = base + 1;
    }
  });
  forEachCorner(u, [&](std::uint32_t corner) {
    const auto [a, b] = others(corner);
    const std::uint32_t va = vertexAt_[a];
    const std::uint32_t vb = vertexAt_[b];
    if (va != v && vb != v) return;
    ++shared;
    std::uint32_t& mark = mark_[va == v ? vb : va];
    mark = base + 2;
  });
  if (shared == 0 || (bothOnBorder && shared != 1)) return false;
  std::uint32_t common = 0;
  bool sheetAtV = false;
  bool sheetAtU = false;
  forEachCorner(v, [&](std::uint32_t corner) {
    const auto [a, b] = others(corner);
    const std::uint32_t va = vertexAt_[a];
    const std::uint32_t vb = vertexAt_[b];
    if (va != u && vb != u && mark_[va] >= base + 2 && mark_[vb] >= base + 2) sheetAtV = true;
    for (const std::uint32_t n : {va, vb}) {
      if (n == u || mark_[n] <= base) continue;
      if (mark_[n] == base + 1) ++common;  // next to both, yet not opposite the edge
      if (mark_[n] <= base + 2) mark_[n] = base + 3;
    }
  });
  if (common != 0) return false;
  if (!sheetAtV) return true;
  forEachCorner(u, [&](std::uint32_t corner) {
    const auto [a, b] = others(corner);
    const std::uint32_t va = vertexAt_[a];
    const std::uint32_t vb = vertexAt_[b];
    if (va != v && vb != v && mark_[va] >= base + 2 && mark_[vb] >= base + 2) sheetAtU = true;
  });
  return !sheetAtU;
}

void CollapseTopology::remove(std::uint32_t face) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    vertexAt_[std::size_t{3} * face + k] = kNone;
    wedgeAt_[std::size_t{3} * face + k] = kNone;
  }
  --aliveFaces_;
}

void CollapseTopology::merge(std::uint32_t u, std::uint32_t v) {
  forEachCorner(v, [&](std::uint32_t corner) { vertexAt_[corner] = u; });
  forEachCorner(u, [](std::uint32_t) {});
  if (head_[v] == kNone) return;
  if (head_[u] == kNone) {
    head_[u] = head_[v];
  } else {
    next_[tail_[u]] = head_[v];
  }
  tail_[u] = tail_[v];
  head_[v] = kNone;
  tail_[v] = kNone;
}

}  // namespace jalousie::bake
