// What the GPU keeps of every object from frame to frame.
#pragma once

#include <cstdint>

#include "gl/buffer.h"

namespace jalousie::visibility {

/// The buffers that VisibilityPass reads as history and overwrites with a frame's decisions. The caller of the pass
/// owns them, and may read them after a frame or write them to start from a given history.
struct ObjectStore {
  /// All zero: no history. Allocates everything; nothing is allocated later. Errors: kLimit.
  explicit ObjectStore(std::uint32_t objectCount, std::uint32_t cellCount = 0);

  /// Forgets what was visible in the last frame, and the price.
  void forget();

  std::uint32_t objectCount;
  gl::Buffer states;       ///< gpu::ObjectState [objectCount]
  gl::Buffer boxes;        ///< gpu::ScreenBox [objectCount]
  gl::Buffer marks;        ///< kMark... [objectCount]
  gl::Buffer pixelCounts;  ///< gpu::uint [objectCount]: visible pixels at the last count
  std::uint32_t cellCount;
  gl::Buffer cellStates;      ///< gpu::ObjectState [cellCount]
  gl::Buffer cellMarks;       ///< kMark... [cellCount]
  gl::Buffer price;           ///< gpu::PriceState, moved where a frame has a budget of triangles
  gl::Buffer budget;          ///< BudgetWords of such a frame
  gl::Buffer drawnTriangles;  ///< gpu::uint [objectCount][2] of such a frame: triangles, cells; one without cells
  bool countsValid = false;   ///< pixelCounts were made in the last frame
};

}  // namespace jalousie::visibility
