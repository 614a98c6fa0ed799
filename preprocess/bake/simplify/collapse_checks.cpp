// Gathers wedges and compares orientations in space and in texture space.
#include "bake/simplify/collapse_checks.h"

#include <algorithm>
#include <array>

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kNoWedge = ~0U;
/// Least cosine between a triangle's normal before and after a collapse.
constexpr double kLeastTurn = 0.25;

double crossOf(const float* a, const float* b, const float* c) {
  return (double{b[0]} - a[0]) * (double{c[1]} - a[1]) - (double{b[1]} - a[1]) * (double{c[0]} - a[0]);
}

/// Numbers the groups from 0 on, in the order of their first wedge.
void numberGroups(WedgeMerge& merge) {
  constexpr std::uint8_t kUnseen = 255;
  std::array<std::uint8_t, WedgeMerge::kMost> numbers;
  numbers.fill(kUnseen);
  merge.groups = 0;
  for (std::size_t i = 0; i < merge.count; ++i) {
    std::uint8_t& number = numbers[merge.group[i]];
    if (number == kUnseen) number = static_cast<std::uint8_t>(merge.groups++);
    merge.group[i] = number;
  }
}

}  // namespace

CollapseChecks::CollapseChecks(const WedgeMesh& source, const std::vector<glm::dvec3>& positions,
                               const CollapseError& error, CollapseTopology& topology)
    : source_(source), positions_(positions), error_(error), topology_(topology) {
  for (const AttributeSlot& slot : source.slots) {
    if (slot.kind == AttributeKind::kTangent && slot.components == 4) signOffset_ = slot.offset + 3;
    if (slot.kind == AttributeKind::kUv && slot.components == 2) uvOffsets_.push_back(slot.offset);
  }
}

bool CollapseChecks::canJoin(std::uint32_t a, std::uint32_t b) const {
  return !signOffset_ || error_.attributes(a)[*signOffset_] * error_.attributes(b)[*signOffset_] >= 0.0F;
}

bool CollapseChecks::gather(std::uint32_t u, std::uint32_t v, std::span<const std::uint32_t> singleWedge,
                            WedgeMerge& merge) {
  if (singleWedge[u] != kNoWedge && singleWedge[v] != kNoWedge) {
    merge.wedges[0] = singleWedge[u];
    merge.wedges[1] = singleWedge[v];
    merge.group[0] = merge.group[1] = 0;
    merge.fromV[0] = 0;
    merge.fromV[1] = 1;
    merge.count = 2;
    merge.groups = 1;
    return canJoin(singleWedge[u], singleWedge[v]);
  }
  merge.count = 0;
  const auto indexOf = [&](std::uint32_t wedge, std::uint8_t fromV) -> std::size_t {
    for (std::size_t i = 0; i < merge.count; ++i)
      if (merge.wedges[i] == wedge) return i;
    if (merge.count == WedgeMerge::kMost) return WedgeMerge::kMost;
    merge.wedges[merge.count] = wedge;
    merge.fromV[merge.count] = fromV;
    merge.group[merge.count] = static_cast<std::uint8_t>(merge.count);
    return merge.count++;
  };
  bool valid = true;
  for (const std::uint32_t vertex : {u, v}) {
    topology_.forEachCorner(vertex, [&](std::uint32_t corner) {
      valid = indexOf(topology_.wedgeAt(corner), vertex == v ? 1 : 0) < WedgeMerge::kMost && valid;
    });
  }
  if (!valid) return false;
  topology_.forEachCorner(u, [&](std::uint32_t corner) {
    for (const std::uint32_t other : CollapseTopology::others(corner)) {
      if (topology_.vertexAt(other) != v) continue;
      const std::uint8_t a = merge.group[indexOf(topology_.wedgeAt(corner), 0)];
      const std::uint8_t b = merge.group[indexOf(topology_.wedgeAt(other), 1)];
      valid = valid && canJoin(topology_.wedgeAt(corner), topology_.wedgeAt(other));
      for (std::size_t i = 0; i < merge.count; ++i)
        if (merge.group[i] == std::max(a, b)) merge.group[i] = std::min(a, b);
    }
  });
  numberGroups(merge);
  return valid;
}

template <class Visit>
void CollapseChecks::forEachStaying(std::uint32_t moved, std::uint32_t other, const Visit& visit) {
  topology_.forEachCorner(moved, [&](std::uint32_t corner) {
    const auto [a, b] = CollapseTopology::others(corner);
    if (topology_.vertexAt(a) != other && topology_.vertexAt(b) != other) visit(corner, a, b);
  });
}

bool CollapseChecks::keepsFacing(std::uint32_t u, std::uint32_t v, const glm::dvec3& p) {
  bool good = true;
  for (const std::uint32_t moved : {u, v}) {
    forEachStaying(moved, moved == u ? v : u, [&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
      if (!good) return;
      const glm::dvec3& pa = positions_[topology_.vertexAt(a)];
      const glm::dvec3& pb = positions_[topology_.vertexAt(b)];
      const glm::dvec3 before = glm::cross(pa - positions_[moved], pb - positions_[moved]);
      const glm::dvec3 after = glm::cross(pa - p, pb - p);
      if (!(glm::dot(before, before) > 0.0)) return;  // a triangle without area faces nowhere
      const double length2 = glm::dot(before, before) * glm::dot(after, after);
      const double cosine = glm::dot(before, after);
      good = cosine > 0.0 && cosine * cosine > kLeastTurn * kLeastTurn * length2;
    });
  }
  return good;
}

bool CollapseChecks::keepsTexture(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge,
                                  const std::vector<float>& values) {
  bool good = true;
  if (uvOffsets_.empty()) return good;
  for (const std::uint32_t moved : {u, v}) {
    forEachStaying(moved, moved == u ? v : u, [&](std::uint32_t corner, std::uint32_t a, std::uint32_t b) {
      if (!good) return;
      const std::uint32_t wedge = topology_.wedgeAt(corner);
      std::size_t i = 0;
      while (merge.wedges[i] != wedge)
        ++i;
      for (const std::uint32_t uv : uvOffsets_) {
        const float* pa = error_.attributes(topology_.wedgeAt(a)) + uv;
        const float* pb = error_.attributes(topology_.wedgeAt(b)) + uv;
        const double before = crossOf(error_.attributes(wedge) + uv, pa, pb);
        const double after = crossOf(&values[merge.group[i] * std::size_t{source_.stride}] + uv, pa, pb);
        good = good && !(before * after < 0.0);
      }
    });
  }
  return good;
}

}  // namespace jalousie::bake
