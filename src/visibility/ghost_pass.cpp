// Marks the culled objects in one dispatch, then builds the list like any other.
#include "visibility/ghost_pass.h"

#include "scene/scene_data.h"
#include "shared/limits.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {

GhostPass::GhostPass(const scene::SceneData& scene, const gl::Program& markProgram)
    : objectCount_(static_cast<std::uint32_t>(scene.drawn().objects.size())),
      markProgram_(markProgram),
      states_(sizeof(gpu::ObjectState) * objectCount_, 0, "ghost states"),
      marks_(sizeof(gpu::uint) * objectCount_, 0, "ghost marks"),
      list_(scene, gpu::kMarkLate, {Submission::kInstanced, objectCount_, scene.maxPatchTriangles > 0}) {}

void GhostPass::build(DrawListPass& lists, const SceneBindings& scene, const ObjectBuffers& frame) {
  if (objectCount_ == 0) return;
  markProgram_.use();
  frame.view->bindUniform(gpu::kBindingCullView);
  scene.drawn().objects->bindStorage(gpu::kBindingObjects);
  scene.drawn().chains->bindStorage(gpu::kBindingChains);
  frame.drawn().states->bindStorage(gpu::kBindingStates);
  frame.drawn().marks->bindStorage(gpu::kBindingMarks);
  states_.bindStorage(gpu::kBindingGhostStates);
  marks_.bindStorage(gpu::kBindingGhostMarks);
  dispatchGroups(objectGroups(objectCount_));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  lists.build(list_, scene, {frame.view, &states_, frame.boxes, &marks_});
}

ObjectBuffers GhostPass::decided(const ObjectBuffers& frame) const {
  // Programs that draw read the objects' states: those of the frame, where the list holds cells.
  return frame.cellMarks != nullptr ? frame : ObjectBuffers{frame.view, &states_, frame.boxes, &marks_};
}

}  // namespace jalousie::visibility
