// Dispatches the kernels that decide per object.
#include "visibility/visibility_pass.h"

#include "core/check.h"
#include "policy/traits.h"
#include "shared/limits.h"
#include "visibility/dispatch.h"
#include "visibility/level_of_visibility.h"

namespace jalousie::visibility {
namespace {

gl::Buffer makeCosines() {
  const auto table = cosineTable();
  return gl::Buffer::fromArray(std::span<const float>(table), "cosines");
}

gl::Texture makeImportance(const ImportanceMask& mask) {
  gl::Texture texture(GL_TEXTURE_2D, GL_R8, {mask.levelWidth(0), mask.levelHeight(0), 1, mask.levels()}, "importance");
  for (std::uint32_t level = 0; level < mask.levels(); ++level)
    texture.uploadBytes(level, mask.level(level));
  texture.setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

VisibilityPass::Programs::Programs(ProgramId objectsId, ProgramId cellsId, bool hasCells,
                                   const gl::ShaderLibrary& shaders)
    : objects(programSource(objectsId), shaders) {
  if (hasCells) cells.emplace(programSource(cellsId), shaders);
}

VisibilityPass::VisibilityPass(ObjectStore& objects, const ImportanceMask* importance, const gl::ShaderLibrary& shaders)
    : objects_(objects),
      classify_(ProgramId::kClassify, ProgramId::kClassifyCells, objects.cellCount > 0, shaders),
      analyseMap_(ProgramId::kAnalyseMap, ProgramId::kAnalyseCellsMap, objects.cellCount > 0, shaders),
      analyseMapDepth_(ProgramId::kAnalyseMapDepth, ProgramId::kAnalyseCellsMapDepth, objects.cellCount > 0, shaders),
      analyseDepth_(ProgramId::kAnalyseDepth, ProgramId::kAnalyseCellsDepth, objects.cellCount > 0, shaders),
      countPixelsProgram_(programSource(ProgramId::kCountPixels), shaders),
      view_(sizeof(gpu::CullView), GL_DYNAMIC_STORAGE_BIT, "cull view"),
      cosines_(makeCosines()) {
  if (importance == nullptr) return;
  importance_ = makeImportance(*importance);
  importanceWidth_ = importance->width();
  importanceHeight_ = importance->height();
}

void VisibilityPass::setView(gpu::CullView view) {
  JAL_CHECK(view.objectCount == objects_.objectCount);
  JAL_CHECK(view.cellCount == objects_.cellCount);
  view.importanceLevels = importance_ ? importance_->size().levels : 0;
  view.importanceWidth = importanceWidth_;
  view.importanceHeight = importanceHeight_;
  view.countsValid = objects_.countsValid ? 1 : 0;
  objects_.countsValid = false;
  view_.writeValue(view);
}

void VisibilityPass::classify(const SceneBindings& scene) {
  if (importance_) importance_->bind(gpu::kUnitImportance);
  objects_.pixelCounts.bindStorage(gpu::kBindingPixelCounts);
  run(classify_, scene);
}

void VisibilityPass::analyse(const SceneBindings& scene, gpu::uint traits, const CoverTextures& cover) {
  const bool usesMap = has(traits, gpu::kTraitUsesMap);
  const bool usesDepth = has(traits, gpu::kTraitUsesDepth);
  JAL_CHECK((traits & (gpu::kTraitUsesMap | gpu::kTraitUsesDepth)) != 0U);
  if (usesMap) cover.map->bind(gpu::kUnitOcclusionMap);
  if (usesDepth) {
    cover.pyramid->bind(gpu::kUnitDepthPyramid);
    cover.depth->bind(gpu::kUnitDepth);
  }
  cosines_.bindStorage(gpu::kBindingCosines);
  run(analysis(traits), scene);
}

const VisibilityPass::Programs& VisibilityPass::analysis(gpu::uint traits) const {
  if (!has(traits, gpu::kTraitUsesDepth)) return analyseMap_;
  return has(traits, gpu::kTraitUsesMap) ? analyseMapDepth_ : analyseDepth_;
}

void VisibilityPass::repeatCells(const SceneBindings& scene, gpu::uint traits, const gl::Buffer& groups,
                                 gpu::uint phase) const {
  if (objects_.cellCount == 0) return;
  const bool late = phase == gpu::kMarkLate;
  if (!late || !has(traits, gpu::kTraitTwoPhases)) dispatchCells(*classify_.cells, scene, &groups);
  // The textures of the test are still bound.
  if (late && has(traits, gpu::kTraitTestsOcclusion)) dispatchCells(*analysis(traits).cells, scene, &groups);
}

void VisibilityPass::countPixels(const gl::Texture& items) {
  objects_.countsValid = true;
  if (objects_.objectCount == 0) return;
  objects_.pixelCounts.clear();
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  countPixelsProgram_.use();
  items.bindImage(gpu::kImageSource, 0, GL_READ_ONLY);
  objects_.pixelCounts.bindStorage(gpu::kBindingPixelCounts);
  const auto groups = [](std::uint32_t pixels, int side) {
    const std::uint32_t step = static_cast<std::uint32_t>(side) * gpu::kTexelGroupSide;
    return (pixels + step - 1) / step;
  };
  glDispatchCompute(groups(items.size().width, gpu::kCountBlockWidth),
                    groups(items.size().height, gpu::kCountBlockHeight), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

ObjectBuffers VisibilityPass::decided() const {
  ObjectBuffers buffers{&view_, &objects_.states, &objects_.boxes, &objects_.marks, &objects_.price};
  if (objects_.cellCount == 0) return buffers;
  buffers.cellStates = &objects_.cellStates;
  buffers.cellMarks = &objects_.cellMarks;
  return buffers;
}

void VisibilityPass::run(const Programs& programs, const SceneBindings& scene) const {
  dispatch(programs.objects, scene);
  if (programs.cells) dispatchCells(*programs.cells, scene, nullptr);
}

void VisibilityPass::dispatchCells(const gl::Program& program, const SceneBindings& scene,
                                   const gl::Buffer* groups) const {
  program.use();
  view_.bindUniform(gpu::kBindingCullView);
  scene.transforms->bindStorage(gpu::kBindingTransforms);
  scene.cells->bindStorage(gpu::kBindingObjects);
  scene.cellChains->bindStorage(gpu::kBindingChains);
  scene.cellBounds->bindStorage(gpu::kBindingCellBounds);
  objects_.states.bindStorage(gpu::kBindingStates);
  objects_.marks.bindStorage(gpu::kBindingMarks);
  objects_.cellStates.bindStorage(gpu::kBindingCellStates);
  objects_.cellMarks.bindStorage(gpu::kBindingCellMarks);
  if (groups != nullptr) {
    dispatchIndirect(*groups, gpu::kBudgetCellGroups);
  } else {
    dispatchGroups(objectGroups(objects_.cellCount));
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void VisibilityPass::dispatch(const gl::Program& program, const SceneBindings& scene) const {
  if (objects_.objectCount == 0) return;
  program.use();
  view_.bindUniform(gpu::kBindingCullView);
  objects_.price.bindUniform(gpu::kBindingPrice);
  scene.transforms->bindStorage(gpu::kBindingTransforms);
  scene.objects->bindStorage(gpu::kBindingObjects);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  objects_.states.bindStorage(gpu::kBindingStates);
  objects_.boxes.bindStorage(gpu::kBindingBoxes);
  objects_.marks.bindStorage(gpu::kBindingMarks);
  dispatchGroups(objectGroups(objects_.objectCount));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace jalousie::visibility
