// How a draw list is submitted.
#pragma once

#include <cstdint>

namespace jalousie::visibility {

/// How a list is drawn. Both draw the same instances in the same order, so their images are identical.
enum class Submission : std::uint32_t {
  kInstanced = 0,  ///< one command per (chain, level) with all its instances
  kPerObject = 1,  ///< one command per instance: the reference
};

}  // namespace jalousie::visibility
