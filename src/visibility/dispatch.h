// Dispatches more workgroups than OpenGL promises in one direction.
#pragma once

#include <algorithm>
#include <cstdint>

#include "gl/handle.h"

namespace jalousie::visibility {

/// glDispatchCompute of at least `groups` workgroups, in rows of up to 65535, the width that OpenGL 4.5 promises. The
/// kernel numbers them with shaders/lib/groups.glsl and skips those behind the last one.
inline void dispatchGroups(std::uint32_t groups) {
  constexpr std::uint32_t kWidest = 65535;
  const std::uint32_t width = std::min(groups, kWidest);
  if (groups > 0) glDispatchCompute(width, (groups - 1) / width + 1, 1);
}

}  // namespace jalousie::visibility
