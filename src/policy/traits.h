// How C++ tests a trait of a frame's policy. GPU twin: shaders/lib/traits.glsl
#pragma once

#include "shared/traits.h"

namespace jalousie {

/// Whether a policy has a trait.
/// @param traits  traitsOf a policy, or gpu::CullView::traits   @param trait  one kTrait... of shared/traits.h
constexpr bool has(gpu::uint traits, gpu::uint trait) {
  return (traits & trait) != 0;
}

}  // namespace jalousie
