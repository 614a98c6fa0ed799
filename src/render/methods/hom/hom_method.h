// Hierarchical occlusion map without depth (Zhang et al. 1997; thesis ch. 3).
#pragma once

#include "render/methods/cull_method.h"

namespace jalousie::render {

/// Draws near objects into an occlusion map, reduces it, and tests all others against it. Not conservative: a map
/// without depth also occludes what lies in front of the occluders.
class HomMethod : public CullMethod {
 public:
  void decide(const FrameContext& frame) noexcept override;
  void redrawCover(const FrameContext& frame) noexcept override;
  void showCover(const FrameContext& frame) noexcept override;
};

}  // namespace jalousie::render
