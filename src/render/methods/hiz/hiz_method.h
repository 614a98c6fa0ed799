// Two-phase culling against a depth pyramid (docs/two_phase_culling.md).
#pragma once

#include "render/methods/cull_method.h"

namespace jalousie::render {

/// Draws what was visible in the last frame, builds the depth pyramid of that, and tests every object against it. What
/// the test finds visible and is not drawn yet goes into the second phase, so no visible object is lost.
class HizMethod : public CullMethod {
 public:
  void decide(const FrameContext& frame) noexcept override;
  void redrawCover(const FrameContext& frame) noexcept override;
  void showCover(const FrameContext& frame) noexcept override;
};

}  // namespace jalousie::render
