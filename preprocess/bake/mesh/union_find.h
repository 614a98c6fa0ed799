// Disjoint sets of indices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace jalousie::bake {

/// Disjoint sets over [0, count), each named by its lowest member. Finding halves paths.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  /// The lowest member of i's set.
  std::uint32_t rootOf(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// Merges the sets of a and b.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = rootOf(a);
    b = rootOf(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// For each index the lowest member of its set.
  std::vector<std::uint32_t> roots() {
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
      parent_[i] = rootOf(i);
    return parent_;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace jalousie::bake
