// Level 1 comes straight from the depth buffer; no copy of the full-size depth is made.
#include "visibility/depth_pyramid_pass.h"

#include <algorithm>

#include "core/check.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {
namespace {

constexpr std::size_t kSliceBytes = 256;  // satisfies every driver's GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT

gl::Buffer makeViews(const MapLayout& layout) {
  std::vector<std::byte> bytes(kSliceBytes * layout.levels);
  gl::Buffer views(bytes.size(), GL_DYNAMIC_STORAGE_BIT, "depth pyramid steps");
  for (std::uint32_t level = 1; level < layout.levels; ++level) {
    const gpu::ReduceView view{layout.screenWidth, layout.screenHeight, level >= 2 ? level - 2 : 0, 0};
    views.write(kSliceBytes * level, std::as_bytes(std::span(&view, 1)));
  }
  return views;
}

gl::Handle<gl::SamplerTraits> makeSampler(GLint minFilter, GLint magFilter) {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, minFilter);
  glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, magFilter);
  glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return gl::Handle<gl::SamplerTraits>(id);
}

}  // namespace

DepthPyramidPass::DepthPyramidPass(const MapLayout& layout, const gl::Capabilities& capabilities,
                                   const gl::ShaderLibrary& shaders)
    : layout_(layout),
      minMaxFilter_(capabilities.minMaxFilter),
      texture_(makeTexture(layout)),
      edgeSampler_(makeSampler(GL_NEAREST, GL_NEAREST)),
      firstProgram_(programSource(ProgramId::kReduceDepthFirst), shaders),
      firstCoveredProgram_(programSource(ProgramId::kReduceDepthFirstCovered), shaders),
      reduceProgram_(programSource(minMaxFilter_ ? ProgramId::kReduceDepthMinMax : ProgramId::kReduceDepth), shaders),
      views_(makeViews(layout)) {
  if (!minMaxFilter_) return;
  minSampler_ = makeSampler(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
  glSamplerParameteri(minSampler_.id(), GL_TEXTURE_REDUCTION_MODE_ARB, GL_MIN);
}

gl::Texture DepthPyramidPass::makeTexture(const MapLayout& layout) {
  gl::Texture texture(GL_TEXTURE_2D, GL_R32F,
                      {layout.levelWidth(1), layout.levelHeight(1), 1, std::max(layout.levels - 1, 1U)},
                      "depth pyramid");
  texture.setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  return texture;
}

void DepthPyramidPass::resize(const MapLayout& layout) {
  texture_ = makeTexture(layout);
  views_ = makeViews(layout);
  layout_ = layout;
}

void DepthPyramidPass::build(const gl::Texture& depth, DepthSource source) const {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  for (std::uint32_t level = 1; level < layout_.levels; ++level) {
    const bool first = level == 1;
    (first ? source == DepthSource::kCovered ? firstCoveredProgram_ : firstProgram_ : reduceProgram_).use();
    (first ? depth : texture_).bind(gpu::kUnitDepth);
    glBindSampler(gpu::kUnitDepth, first ? edgeSampler_.id() : minSampler_.id());  // 0: the texture's own
    texture_.bindImage(gpu::kImageTarget, level - 1, GL_WRITE_ONLY);
    views_.bindUniformRange(gpu::kBindingReduceView, kSliceBytes * level, sizeof(gpu::ReduceView));
    const auto groups = [](std::uint32_t texels) { return (texels + gpu::kTexelGroupSide - 1) / gpu::kTexelGroupSide; };
    glDispatchCompute(groups(layout_.levelWidth(level)), groups(layout_.levelHeight(level)), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  glBindSampler(gpu::kUnitDepth, 0);
}

std::vector<float> DepthPyramidPass::readLevel(std::uint32_t level) const {
  JAL_CHECK(level >= 1U);
  std::vector<float> values(std::size_t{layout_.levelWidth(level)} * layout_.levelHeight(level));
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glGetTextureImage(texture_.id(), static_cast<GLint>(level - 1), GL_RED, GL_FLOAT,
                    static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
  return values;
}

}  // namespace jalousie::visibility
