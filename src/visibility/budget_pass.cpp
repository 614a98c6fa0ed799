// sum -> plan -> forecast -> limit, the last two only where the frame has too many triangles.
#include "visibility/budget_pass.h"

#include "policy/traits.h"
#include "shared/limits.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {

BudgetPass::BudgetPass(ObjectStore& objects, const gl::ShaderLibrary& shaders)
    : objects_(objects),
      sumProgram_(programSource(ProgramId::kBudgetSum), shaders),
      planProgram_(programSource(ProgramId::kBudgetPlan), shaders),
      forecastProgram_(programSource(ProgramId::kBudgetForecast), shaders),
      limitProgram_(programSource(ProgramId::kBudgetLimit), shaders),
      moveProgram_(programSource(ProgramId::kAdjustPrice), shaders) {
  if (objects.cellCount > 0) sumCellsProgram_.emplace(programSource(ProgramId::kBudgetSumOfCells), shaders);
}

void BudgetPass::limit(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                       const DrawList& list) {
  if (view.objectCount == 0) return;
  const bool late = list.view().phase == gpu::kMarkLate;
  clear(late && has(view.traits, gpu::kTraitTwoPhases));
  list.bindView(gpu::kBindingListView);
  decided.view->bindUniform(gpu::kBindingCullView);
  objects_.price.bindUniform(gpu::kBindingPrice);
  objects_.budget.bindStorage(gpu::kBindingBudget);
  sum(scene, decided, view);
  planProgram_.use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  run(forecastProgram_, scene, decided);
  run(limitProgram_, scene, decided);
}

void BudgetPass::clear(bool second) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const GLintptr first = second ? gpu::kBudgetDrawn * sizeof(gpu::uint) : 0;
  const auto bytes = static_cast<GLsizeiptr>(sizeof(BudgetWords)) - first;
  glClearNamedBufferSubData(objects_.budget.id(), GL_R32UI, first, bytes, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  if (objects_.cellCount > 0) objects_.drawnTriangles.clear();
}

void BudgetPass::sum(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view) {
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingMarks);
  if (sumCellsProgram_) {
    sumCellsProgram_->use();
    scene.cells->bindStorage(gpu::kBindingObjects);
    scene.cellChains->bindStorage(gpu::kBindingChains);
    scene.cellLods->bindStorage(gpu::kBindingLods);
    decided.cellMarks->bindStorage(gpu::kBindingCellMarks);
    objects_.drawnTriangles.bindStorage(gpu::kBindingDrawnOfCells);
    dispatchGroups(objectGroups(view.cellCount));
  } else {
    sumProgram_.use();
    scene.objects->bindStorage(gpu::kBindingObjects);
    scene.chains->bindStorage(gpu::kBindingChains);
    scene.lods->bindStorage(gpu::kBindingLods);
    dispatchGroups(objectGroups(view.objectCount));
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void BudgetPass::run(const gl::Program& program, const SceneBindings& scene, const ObjectBuffers& decided) const {
  program.use();
  scene.objects->bindStorage(gpu::kBindingObjects);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.boxes->bindStorage(gpu::kBindingBoxes);
  decided.marks->bindStorage(gpu::kBindingMarks);
  objects_.drawnTriangles.bindStorage(gpu::kBindingDrawnOfObjects);
  dispatchIndirect(objects_.budget, gpu::kBudgetObjectGroups);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void BudgetPass::movePrice(const ObjectBuffers& decided, const DrawList& list) {
  moveProgram_.use();
  list.bindView(gpu::kBindingListView);
  decided.view->bindUniform(gpu::kBindingCullView);
  objects_.budget.bindStorage(gpu::kBindingBudget);
  decided.price->bindStorage(gpu::kBindingPriceState);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace jalousie::visibility
