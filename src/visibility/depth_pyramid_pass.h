// The farthest-depth pyramid on the GPU (docs/two_phase_culling.md).
#pragma once

#include <vector>

#include "gl/buffer.h"
#include "gl/capabilities.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "visibility/map_layout.h"

namespace jalousie::visibility {

/// Which pixels of the depth buffer count.
enum class DepthSource {
  kAll,      ///< pixels without a surface are infinitely far
  kCovered,  ///< pixels without a surface do not count; for modes whose occlusion map has the covered share
};

/// One pyramid for one screen size. CPU twin: DepthPyramidReference.
class DepthPyramidPass {
 public:
  DepthPyramidPass(const MapLayout& layout, const gl::Capabilities& capabilities,
                   const gl::ShaderLibrary& shaders = {});
  /// Another size; keeps the programs.
  void resize(const MapLayout& layout);

  const MapLayout& layout() const { return layout_; }
  /// Level L of the screen (L >= 1) is level L - 1 of this texture.
  const gl::Texture& texture() const { return texture_; }
  /// @param depth  GL_DEPTH_COMPONENT32F of the screen's size. Leaves a TEXTURE_FETCH barrier behind.
  void build(const gl::Texture& depth, DepthSource source) const;
  /// One level above 0 with its padding; waits for the GPU. For tests.
  std::vector<float> readLevel(std::uint32_t level) const;

 private:
  static gl::Texture makeTexture(const MapLayout& layout);

  MapLayout layout_;
  bool minMaxFilter_;
  gl::Texture texture_;
  gl::Handle<gl::SamplerTraits> edgeSampler_;  ///< replaces the wrapping of the depth texture
  gl::Handle<gl::SamplerTraits> minSampler_;   ///< reduces four texels to their minimum, with minMaxFilter_
  gl::Program firstProgram_;
  gl::Program firstCoveredProgram_;
  gl::Program reduceProgram_;
  gl::Buffer views_;  ///< gpu::ReduceView, one slice per level
};

}  // namespace jalousie::visibility
