// What may be read into one scene.
#pragma once

#include <cstdint>

namespace jalousie::asset::detail {

/// What may still be read into one scene; taken from Limits::maxAccessorElements for all meshes together.
struct ElementBudget {
  std::uint64_t left;
  /// Errors: kLimit.
  void take(std::uint64_t elements);
};

}  // namespace jalousie::asset::detail
