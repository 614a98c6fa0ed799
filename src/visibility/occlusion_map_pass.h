// The occlusion map on the GPU: occluders drawn into level 0, reduced to 1x1 (thesis 3.3).
#pragma once

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "visibility/occlusion_map_reference.h"

namespace jalousie::visibility {

/// One map for one screen size. CPU twin: OcclusionMapReference.
class OcclusionMapPass {
 public:
  explicit OcclusionMapPass(const MapLayout& layout);

  const MapLayout& layout() const { return layout_; }
  const gl::Texture& texture() const { return texture_; }

  /// Binds level 0 for drawing and opens every pixel. Draw the occluders next, writing 0 where they cover.
  void beginOccluders() const;
  /// Sums up the levels. Leaves a TEXTURE_FETCH barrier behind.
  void reduce() const;
  /// Level 0 of the screen, row 0 at the bottom; waits for the GPU. For tests.
  std::vector<float> readOpenPixels() const;

 private:
  MapLayout layout_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
  gl::Program reduceProgram_;
};

}  // namespace jalousie::visibility
