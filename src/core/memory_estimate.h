// What a task is about to allocate, added up before it allocates anything, and the limit on the sum.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/memory_limit.h"

namespace jalousie {

/// A sum of estimated allocations of one moment. Sums saturate.
class MemoryEstimate {
 public:
  /// Adds `count` elements of `bytesEach`. @param what  they are, with their number: "16777216 instances"
  void add(std::uint64_t count, std::uint64_t bytesEach, const std::string& what);
  /// Adds the items of another estimate that are allocated at the same time.
  void add(const MemoryEstimate& other);

  std::uint64_t bytes() const { return bytes_; }
  /// Largest single item; empty without items.
  const std::string& largestItem() const { return largest_; }

  /// Does nothing if the sum is within the limit. Errors: kLimit "FILE: needs about N MiB for WHAT, the limit is
  /// M MiB; OPTION lifts it"; where the largest item is less than nine tenths of the sum: "needs about N MiB, K MiB of
  /// them for WHAT, ...".
  void require(const MemoryLimit& limit, const std::filesystem::path& file = {}) const;

 private:
  std::uint64_t bytes_ = 0;
  std::uint64_t largestBytes_ = 0;
  std::string largest_;
};

/// a * b, or the largest number where the product has no room.
std::uint64_t saturatingProduct(std::uint64_t a, std::uint64_t b);

}  // namespace jalousie
