// Priority queue of collapses, in buckets of nearly equal error.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
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
/// The buckets of one exponent are made when one of them is needed: a small mesh uses few.
class CollapseQueue {
 public:
  CollapseQueue() = default;
  CollapseQueue(const CollapseQueue& other) : lowest_(other.lowest_) {
    for (std::size_t i = 0; i < octaves_.size(); ++i)
      if (other.octaves_[i]) octaves_[i] = std::make_unique<Octave>(*other.octaves_[i]);
  }
  CollapseQueue& operator=(const CollapseQueue&) = delete;
  ~CollapseQueue() = default;

  /// NaN and negative costs count as zero, infinite costs as the largest number.
  void push(Candidate candidate) {
    if (!(candidate.cost > 0.0F)) candidate.cost = 0.0F;
    candidate.cost = std::min(candidate.cost, std::numeric_limits<float>::max());
    const std::size_t bucket = std::bit_cast<std::uint32_t>(candidate.cost) >> kShift;
    std::unique_ptr<Octave>& octave = octaves_[bucket / kPerOctave];
    if (!octave) octave = std::make_unique<Octave>();
    (*octave)[bucket % kPerOctave].push_back(candidate);
    if (bucket < lowest_) lowest_ = bucket;
  }
  void clear() {
    octaves_ = {};
    lowest_ = kBuckets;
  }
  bool empty() {
    while (lowest_ < kBuckets) {
      const std::unique_ptr<Octave>& octave = octaves_[lowest_ / kPerOctave];
      if (!octave) {
        lowest_ = (lowest_ / kPerOctave + 1) * kPerOctave;
      } else if ((*octave)[lowest_ % kPerOctave].empty()) {
        ++lowest_;
      } else {
        return false;
      }
    }
    return true;
  }
  /// @pre not empty
  Candidate pop() {
    std::vector<Candidate>& bucket = (*octaves_[lowest_ / kPerOctave])[lowest_ % kPerOctave];
    const Candidate candidate = bucket.back();
    bucket.pop_back();
    return candidate;
  }

 private:
  static constexpr unsigned kShift = 18;  // sign, 8 bits of exponent, 5 of mantissa stay
  static constexpr std::size_t kPerOctave = 32;
  static constexpr std::size_t kBuckets = 256 * kPerOctave;
  using Octave = std::array<std::vector<Candidate>, kPerOctave>;
  std::array<std::unique_ptr<Octave>, kBuckets / kPerOctave> octaves_;
  std::size_t lowest_ = kBuckets;
};

}  // namespace jalousie::bake
