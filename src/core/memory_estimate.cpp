// Saturating sums and the text of a refusal.
#include "core/memory_estimate.h"

#include <limits>

#include "core/error.h"

namespace jalousie {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

std::uint64_t saturatingSum(std::uint64_t a, std::uint64_t b) {
  return a > kMost - b ? kMost : a + b;
}

/// Rounded up, so that a refused need never reads like the limit.
std::string mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes >> 20U) + ((bytes & 0xFFFFFU) != 0 ? 1 : 0)) + " MiB";
}

}  // namespace

std::uint64_t saturatingProduct(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kMost / b ? kMost : a * b;
}

void MemoryEstimate::add(std::uint64_t count, std::uint64_t bytesEach, const std::string& what) {
  const std::uint64_t bytes = saturatingProduct(count, bytesEach);
  bytes_ = saturatingSum(bytes_, bytes);
  if (bytes <= largestBytes_) return;
  largestBytes_ = bytes;
  largest_ = what;
}

void MemoryEstimate::add(const MemoryEstimate& other) {
  bytes_ = saturatingSum(bytes_, other.bytes_);
  if (other.largestBytes_ <= largestBytes_) return;
  largestBytes_ = other.largestBytes_;
  largest_ = other.largest_;
}

void MemoryEstimate::require(const MemoryLimit& limit, const std::filesystem::path& file) const {
  if (limit.bytes == 0 || bytes_ <= limit.bytes) return;
  const bool mostly = largestBytes_ >= bytes_ / 10 * 9;
  std::string text = "needs about " + mebibytes(bytes_);
  text += (mostly ? std::string() : ", " + mebibytes(largestBytes_) + " of them") + " for " + largest_;
  text += ", the limit is " + mebibytes(limit.bytes);
  if (limit.option != nullptr) text += std::string("; ") + limit.option + " lifts it";
  throw Error(ErrorCode::kLimit, text, file);
}

}  // namespace jalousie
