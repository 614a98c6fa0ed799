// Hierarchical occlusion map in which a texel occludes only what lies behind it (docs/occlusion_map.md).
#pragma once

#include "render/methods/cull_method.h"

namespace jalousie::render {

/// As HomMethod, and reads the depth of the occluders from a depth pyramid of the covered pixels.
class HomDepthMethod : public CullMethod {
 public:
  void decide(const FrameContext& frame) noexcept override;
  void redrawCover(const FrameContext& frame) noexcept override;
  void showCover(const FrameContext& frame) noexcept override;
};

}  // namespace jalousie::render
