// Dispatches of the deciding kernels.
#include "visibility/visibility_pass.h"

#include "core/check.h"
#include "shared/limits.h"
#include "visibility/level_of_visibility.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {
namespace {

gl::Buffer makeCosines() {
  const auto table = cosineTable();
  return gl::Buffer::fromArray(std::span<const float>(table), "cosines");
}

gl::Buffer makeStorage(std::size_t bytes, const char* name) {
  gl::Buffer buffer(bytes, GL_DYNAMIC_STORAGE_BIT, name);
  buffer.clear();
  return buffer;
}

gl::Texture makeImportance(const ImportanceMask& mask) {
  gl::Texture texture(GL_TEXTURE_2D, GL_R8, {mask.levelWidth(0), mask.levelHeight(0), 1, mask.levels()}, "importance");
  for (std::uint32_t level = 0; level < mask.levels(); ++level)
    texture.uploadBytes(level, mask.level(level));
  texture.setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

VisibilityPass::VisibilityPass(std::uint32_t objectCount, const ImportanceMask* importance)
    : objectCount_(objectCount),
      classifyProgram_(programSource(ProgramId::kClassify)),
      analyseMapProgram_(programSource(ProgramId::kAnalyseMap)),
      analyseMapDepthProgram_(programSource(ProgramId::kAnalyseMapDepth)),
      analyseDepthProgram_(programSource(ProgramId::kAnalyseDepth)),
      view_(sizeof(gpu::CullView), GL_DYNAMIC_STORAGE_BIT, "cull view"),
      cosines_(makeCosines()),
      states_(makeStorage(sizeof(gpu::ObjectState) * objectCount, "object states")),
      boxes_(makeStorage(sizeof(gpu::ScreenBox) * objectCount, "screen boxes")),
      marks_(makeStorage(sizeof(gpu::uint) * objectCount, "object marks")) {
  if (importance == nullptr) return;
  importance_ = makeImportance(*importance);
  importanceWidth_ = importance->width();
  importanceHeight_ = importance->height();
}

void VisibilityPass::setView(gpu::CullView view) {
  JAL_CHECK(view.objectCount == objectCount_);
  view.importanceLevels = importance_ ? importance_->size().levels : 0;
  view.importanceWidth = importanceWidth_;
  view.importanceHeight = importanceHeight_;
  view_.writeValue(view);
}

void VisibilityPass::classify(const SceneBindings& scene) {
  if (importance_) importance_->bind(gpu::kUnitImportance);
  dispatch(classifyProgram_, scene);
}

void VisibilityPass::analyse(const SceneBindings& scene, gpu::uint cullMode, const CoverTextures& cover) {
  if (cullMode != gpu::kCullHiz) cover.map->texture().bind(gpu::kUnitOcclusionMap);
  if (cullMode != gpu::kCullHom) {
    cover.pyramid->texture().bind(gpu::kUnitDepthPyramid);
    cover.depth->bind(gpu::kUnitDepth);
  }
  cosines_.bindStorage(gpu::kBindingCosines);
  dispatch(cullMode == gpu::kCullHom        ? analyseMapProgram_
           : cullMode == gpu::kCullHomDepth ? analyseMapDepthProgram_
                                            : analyseDepthProgram_,
           scene);
}

void VisibilityPass::dispatch(const gl::Program& program, const SceneBindings& scene) const {
  if (objectCount_ == 0) return;
  program.use();
  view_.bindUniform(gpu::kBindingCullView);
  scene.transforms->bindStorage(gpu::kBindingTransforms);
  scene.objects->bindStorage(gpu::kBindingObjects);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  states_.bindStorage(gpu::kBindingStates);
  boxes_.bindStorage(gpu::kBindingBoxes);
  marks_.bindStorage(gpu::kBindingMarks);
  glDispatchCompute((objectCount_ + gpu::kObjectGroupSize - 1) / gpu::kObjectGroupSize, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace jalousie::visibility
