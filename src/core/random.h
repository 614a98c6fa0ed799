// Random numbers that are the same on every machine: PCG32 (O'Neill 2014) and our own distributions,
// because the standard library's distributions are not specified bit for bit.
#pragma once

#include <cstdint>

namespace jalousie {

/// PCG-XSH-RR 64/32. Same seed, same sequence, everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(0) {
    next();
    state_ += seed;
    next();
  }

  /// Uniform 32-bit integer.
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<std::uint32_t>(old >> 59U);
    return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
  }

  /// Uniform in [0, 1), 24 bits, exactly representable.
  float uniform() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }
  /// Uniform in [low, high).
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, count); count > 0. The bias is below 2^-32 * count.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * count) >> 32U);
  }

 private:
  std::uint64_t state_;
};

}  // namespace jalousie
