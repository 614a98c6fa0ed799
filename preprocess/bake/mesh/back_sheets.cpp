// Pairs triangles by their sorted corners, then colours the two sheets across shared edges.
#include "bake/mesh/back_sheets.h"

#include <algorithm>
#include <array>

#include "bake/mesh/union_find.h"

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kNone = ~0U;

struct Corners {
  std::array<std::uint32_t, 3> sorted;
  bool even;  ///< whether the winding is that of the sorted corners
  std::uint32_t triangle;
};

/// For each triangle the one with the same corners in the other winding, if there are just these two.
std::vector<std::uint32_t> findTwins(std::span<const std::uint32_t> vertices) {
  std::vector<Corners> all;
  all.reserve(vertices.size() / 3);
  for (std::uint32_t t = 0; t < vertices.size() / 3; ++t) {
    std::array<std::uint32_t, 3> v = {vertices[3 * t], vertices[3 * t + 1], vertices[3 * t + 2]};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    const bool even = v[1] < v[2];
    if (!even) std::swap(v[1], v[2]);
    all.push_back({v, even, t});
  }
  std::sort(all.begin(), all.end(), [](const Corners& a, const Corners& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle;
  });
  std::vector<std::uint32_t> twins(all.size(), kNone);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].sorted == all[i].sorted)
      ++end;
    if (end - i == 2 && all[i].even != all[i + 1].even) {
      twins[all[i].triangle] = all[i + 1].triangle;
      twins[all[i + 1].triangle] = all[i].triangle;
    }
    i = end;
  }
  return twins;
}

/// A triangle at an edge between vertices low < high.
struct EdgeUse {
  std::uint32_t low, high;
  bool forward;  ///< it runs from low to high
  std::uint32_t triangle;
};

std::vector<EdgeUse> sortedUses(std::span<const std::uint32_t> vertices) {
  std::vector<EdgeUse> uses;
  uses.reserve(vertices.size());
  for (std::uint32_t c = 0; c < vertices.size(); ++c) {
    const std::uint32_t a = vertices[c];
    const std::uint32_t b = vertices[c % 3 == 2 ? c - 2 : c + 1];
    uses.push_back({std::min(a, b), std::max(a, b), a < b, c / 3});
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    if (x.low != y.low) return x.low < y.low;
    if (x.high != y.high) return x.high < y.high;
    return x.triangle < y.triangle;
  });
  return uses;
}

/// Sheets as sets of elements: 2 t is triangle t in the first sheet of its patch, 2 t + 1 in the second.
class Sheets {
 public:
  explicit Sheets(const std::vector<std::uint32_t>& twins)
      : twins_(twins), sides_(2 * twins.size()), patches_(twins.size()), broken_(twins.size(), false) {
    for (std::uint32_t t = 0; t < twins.size(); ++t)
      if (twins[t] != kNone) join(t, twins[t], true);
  }

  /// All triangles at one edge.
  void addEdge(std::span<const EdgeUse> uses) {
    const bool allTwins =
        std::all_of(uses.begin(), uses.end(), [&](const EdgeUse& use) { return twins_[use.triangle] != kNone; });
    for (const EdgeUse& use : uses) {
      if (!allTwins) broken_[use.triangle] = true;
      if (twins_[use.triangle] == kNone) continue;
      patches_.unite(uses.front().triangle, use.triangle);
    }
    if (!allTwins || uses.size() != 4) {
      if (uses.size() > 4)
        for (const EdgeUse& use : uses)
          broken_[use.triangle] = true;
      return;
    }
    for (const EdgeUse& a : uses)
      for (const EdgeUse& b : uses)
        if (a.forward && !b.forward && twins_[a.triangle] != b.triangle) join(a.triangle, b.triangle, false);
  }

  std::vector<std::uint8_t> second() {
    for (std::uint32_t t = 0; t < twins_.size(); ++t)
      if (broken_[t] || sides_.rootOf(2 * t) == sides_.rootOf(2 * t + 1)) broken_[patches_.rootOf(t)] = true;
    std::vector<std::uint8_t> result(twins_.size(), 0);
    bool any = false;
    for (std::uint32_t t = 0; t < twins_.size(); ++t) {
      if (twins_[t] == kNone || broken_[patches_.rootOf(t)]) continue;
      result[t] = sides_.rootOf(2 * t) > sides_.rootOf(2 * t + 1) ? 1 : 0;
      any = any || result[t] != 0;
    }
    return any ? result : std::vector<std::uint8_t>();
  }

 private:
  void join(std::uint32_t a, std::uint32_t b, bool opposite) {
    const std::uint32_t flip = opposite ? 1 : 0;
    sides_.unite(2 * a, 2 * b + flip);
    sides_.unite(2 * a + 1, 2 * b + 1 - flip);
    patches_.unite(a, b);
  }

  const std::vector<std::uint32_t>& twins_;
  UnionFind sides_, patches_;
  std::vector<bool> broken_;
};

}  // namespace

std::vector<std::uint8_t> findBackSheets(std::span<const std::uint32_t> vertices) {
  const std::vector<std::uint32_t> twins = findTwins(vertices);
  if (std::all_of(twins.begin(), twins.end(), [](std::uint32_t twin) { return twin == kNone; })) return {};
  Sheets sheets(twins);
  const std::vector<EdgeUse> uses = sortedUses(vertices);
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i;
    while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high)
      ++end;
    sheets.addEdge(std::span(uses).subspan(i, end - i));
    i = end;
  }
  return sheets.second();
}

}  // namespace jalousie::bake
