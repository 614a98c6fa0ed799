// Priority queue of collapses, in buckets of nearly equal error.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace jalousie::bake {

/// An edge (u, v) and the error of its collapse, or a loose part u with v = kNone. The entry is stale if `version` is
/// not the sum of the versions of u and v.
struct Candidate {
  static constexpr std::uint32_t kNone = ~0U;
  float cost = 0.0F;
  std::uint32_t u = 0, v = 0;
  std::uint32_t version = 0;
};

/// Buckets are 3 % wide, by the leading bits of the error; within a bucket the last entry leaves first. The cache
/// misses of a heap took a third of the collapse time of a chain with 870,000 triangles; the exact order matters less.
class CollapseQueue {
 public:
  CollapseQueue() : buckets_((std::uint32_t{0x7F800000U} >> kShift) + 1) {}

  /// NaN and negative costs count as zero, infinite costs as the largest number.
  void push(Candidate candidate) {
    if (!(candidate.cost > 0.0F)) candidate.cost = 0.0F;
    candidate.cost = std::min(candidate.cost, std::numeric_limits<float>::max());
    const std::size_t bucket = std::bit_cast<std::uint32_t>(candidate.cost) >> kShift;
    buckets_[bucket].push_back(candidate);
    if (bucket < lowest_) lowest_ = bucket;
  }
  bool empty() {
    while (lowest_ < buckets_.size() && buckets_[lowest_].empty())
      ++lowest_;
    return lowest_ == buckets_.size();
  }
  /// @pre not empty
  Candidate pop() {
    const Candidate candidate = buckets_[lowest_].back();
    buckets_[lowest_].pop_back();
    return candidate;
  }

 private:
  static constexpr unsigned kShift = 18;  // sign, 8 bits of exponent, 5 of mantissa stay
  std::vector<std::vector<Candidate>> buckets_;
  std::size_t lowest_ = 0;
};

}  // namespace jalousie::bake
