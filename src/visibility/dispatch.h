// Dispatches more workgroups than OpenGL promises in one direction.
#pragma once

#include <algorithm>
#include <cstdint>

#include "gl/buffer.h"
#include "shared/limits.h"

namespace jalousie::visibility {

/// glDispatchCompute of at least `groups` workgroups, in rows of up to 65535, the width that OpenGL 4.5 promises. The
/// kernel numbers them with shaders/lib/groups.glsl and skips those behind the last one.
inline void dispatchGroups(std::uint32_t groups) {
  constexpr std::uint32_t kWidest = 65535;
  const std::uint32_t width = std::min(groups, kWidest);
  if (groups > 0) glDispatchCompute(width, (groups - 1) / width + 1, 1);
}

/// glDispatchComputeIndirect of the three words at an index of a buffer of words.
inline void dispatchIndirect(const gl::Buffer& words, std::uint32_t index) {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, words.id());
  glDispatchComputeIndirect(static_cast<GLintptr>(index * sizeof(gpu::uint)));
}

/// Workgroups of a kernel with one thread for each object (shaders/lib/groups.glsl, threadNumber).
inline std::uint32_t objectGroups(std::uint32_t threads) {
  return (threads + gpu::kObjectGroupSize - 1) / gpu::kObjectGroupSize;
}

}  // namespace jalousie::visibility
