// How much memory a task may use.
#pragma once

#include <cstdint>

namespace jalousie {

/// A limit on memory, and the option that changes it.
struct MemoryLimit {
  std::uint64_t bytes = 0;       ///< 0: no limit
  const char* option = nullptr;  ///< named in the refusal, e.g. "--max-memory"; null: none
};

/// The limit that programs have where none is given (docs/memory.md).
inline constexpr std::uint64_t kDefaultMaxMemory = 2ULL << 30U;

}  // namespace jalousie
