// The occlusion map on the GPU: occluders drawn into level 0, reduced to 1x1 (thesis 3.3).
#pragma once

#include <optional>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "visibility/map_layout.h"

namespace jalousie::visibility {

/// One map for one screen size. CPU twin: OcclusionMapReference.
class OcclusionMapPass {
 public:
  /// @param depth  GL_DEPTH_COMPONENT32F of the screen's size, for occluders drawn with a depth test; may be null
  OcclusionMapPass(const MapLayout& layout, const gl::Texture* depth, const gl::ShaderLibrary& shaders = {});
  /// Another size; keeps the program.
  void resize(const MapLayout& layout, const gl::Texture* depth);

  const MapLayout& layout() const { return layout_; }
  const gl::Texture& texture() const { return texture_; }

  /// Binds level 0 for drawing and opens every pixel. Draw the occluders next, writing 0 where they cover.
  /// @param withDepth  clears the depth as well and tests against it; needs the constructor's depth (checked)
  void beginOccluders(bool withDepth) const;
  /// Sums up the levels. Leaves a TEXTURE_FETCH barrier behind.
  void reduce() const;
  /// Level 0 of the screen, row 0 at the bottom; waits for the GPU. For tests.
  std::vector<float> readOpenPixels() const;

 private:
  OcclusionMapPass(const MapLayout& layout, const gl::Texture* depth, gl::Program reduceProgram);

  MapLayout layout_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
  std::optional<gl::Framebuffer> depthFramebuffer_;
  gl::Program reduceProgram_;
};

}  // namespace jalousie::visibility
