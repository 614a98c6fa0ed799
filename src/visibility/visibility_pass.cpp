// Binds, dispatches, and places the barriers each kernel owes.
#include "visibility/visibility_pass.h"

#include "core/check.h"
#include "shared/limits.h"
#include "visibility/level_of_visibility.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {

VisibilityPass::VisibilityPass(std::uint32_t objectCount)
    : objectCount_(objectCount),
      classifyProgram_(programSource(ProgramId::kClassify)),
      analyseProgram_(programSource(ProgramId::kAnalyse)),
      emitProgram_(programSource(ProgramId::kEmitCommands)),
      view_(sizeof(gpu::CullView), GL_DYNAMIC_STORAGE_BIT, "cull view"),
      states_(sizeof(gpu::ObjectState) * objectCount, GL_DYNAMIC_STORAGE_BIT, "object states"),
      rects_(sizeof(gpu::ScreenRect) * objectCount, GL_DYNAMIC_STORAGE_BIT, "screen rectangles"),
      commands_(sizeof(gpu::DrawCommand) * gpu::kListCount * objectCount, GL_DYNAMIC_STORAGE_BIT, "draw commands") {
  const auto table = cosineTable();
  cosines_ = gl::Buffer::fromArray(std::span<const float>(table), "cosines");
}

void VisibilityPass::setView(const gpu::CullView& view) {
  JAL_CHECK(view.objectCount == objectCount_);
  view_.writeValue(view);
}

void VisibilityPass::classify(const SceneBindings& scene) {
  dispatch(classifyProgram_, scene, GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void VisibilityPass::analyse(const SceneBindings& scene, const OcclusionMapPass& map) {
  map.texture().bind(gpu::kUnitOcclusionMap);
  cosines_.bindStorage(gpu::kBindingCosines);
  dispatch(analyseProgram_, scene, GL_SHADER_STORAGE_BARRIER_BIT);
}

void VisibilityPass::emitCommands(const SceneBindings& scene) {
  dispatch(emitProgram_, scene, GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void VisibilityPass::dispatch(const gl::Program& program, const SceneBindings& scene, GLbitfield barriers) const {
  if (objectCount_ == 0) return;
  program.use();
  view_.bindUniform(gpu::kBindingCullView);
  scene.objects->bindStorage(gpu::kBindingObjects);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  states_.bindStorage(gpu::kBindingStates);
  rects_.bindStorage(gpu::kBindingRects);
  commands_.bindStorage(gpu::kBindingCommands);
  glDispatchCompute((objectCount_ + gpu::kObjectGroupSize - 1) / gpu::kObjectGroupSize, 1, 1);
  glMemoryBarrier(barriers);
}

}  // namespace jalousie::visibility
