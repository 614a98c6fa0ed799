// Level 0 is a colour attachment; the other levels are compute-shader sums.
#include "visibility/occlusion_map_pass.h"

#include <array>
#include <utility>

#include "core/check.h"
#include "shared/limits.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {

OcclusionMapPass::OcclusionMapPass(const MapLayout& layout, const gl::Texture* depth, const gl::ShaderLibrary& shaders)
    : OcclusionMapPass(layout, depth, gl::Program(programSource(ProgramId::kReduceMap), shaders)) {}

void OcclusionMapPass::resize(const MapLayout& layout, const gl::Texture* depth) {
  *this = OcclusionMapPass(layout, depth, std::move(reduceProgram_));
}

OcclusionMapPass::OcclusionMapPass(const MapLayout& layout, const gl::Texture* depth, gl::Program reduceProgram)
    : layout_(layout),
      texture_(GL_TEXTURE_2D, GL_R32F, {layout.width, layout.height, 1, layout.levels}, "occlusion map"),
      framebuffer_(texture_, nullptr, "occlusion map level 0"),
      reduceProgram_(std::move(reduceProgram)) {
  texture_.setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  if (depth != nullptr) depthFramebuffer_.emplace(texture_, depth, "occlusion map level 0 with depth");
  texture_.clear(0, 0.0F);  // the padding around the screen never has open pixels
}

void OcclusionMapPass::beginOccluders(bool withDepth) const {
  if (withDepth) JAL_CHECK(depthFramebuffer_.has_value());
  const gl::Framebuffer& framebuffer = withDepth ? *depthFramebuffer_ : framebuffer_;
  framebuffer.bind(layout_.screenWidth, layout_.screenHeight);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, static_cast<GLsizei>(layout_.screenWidth), static_cast<GLsizei>(layout_.screenHeight));
  const std::array<float, 4> open = {1.0F, 1.0F, 1.0F, 1.0F};
  glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, open.data());
  const float farDepth = 0.0F;  // reversed depth
  if (withDepth) glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &farDepth);
  glDisable(GL_SCISSOR_TEST);
}

void OcclusionMapPass::reduce() const {
  reduceProgram_.use();
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  for (std::uint32_t level = 1; level < layout_.levels; ++level) {
    texture_.bindImage(gpu::kImageSource, level - 1, GL_READ_ONLY);
    texture_.bindImage(gpu::kImageTarget, level, GL_WRITE_ONLY);
    const auto groups = [](std::uint32_t texels) { return (texels + gpu::kTexelGroupSide - 1) / gpu::kTexelGroupSide; };
    glDispatchCompute(groups(layout_.levelWidth(level)), groups(layout_.levelHeight(level)), 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::vector<float> OcclusionMapPass::readOpenPixels() const {
  return framebuffer_.readRed(layout_.screenWidth, layout_.screenHeight);
}

}  // namespace jalousie::visibility
