// The kernels that keep frames within a budget of triangles.
#pragma once

#include <optional>

#include "gl/program.h"
#include "visibility/draw_list_pass.h"
#include "visibility/object_store.h"
#include "visibility/pass_bindings.h"
#include "visibility/triangle_budget.h"

namespace jalousie::visibility {

/// Per frame: limit before each list is built from which something is drawn into the frame, then movePrice. Nothing is
/// read back: where a frame is within its budget, the kernels that make levels coarser run without a workgroup.
class BudgetPass {
 public:
  /// Keeps a reference to objects, which must outlive the pass. Nothing is allocated later.
  explicit BudgetPass(ObjectStore& objects, const gl::ShaderLibrary& shaders = {});

  /// Makes levels coarser where the frame would have too many triangles. In scenes with cells the caller has to decide
  /// about the cells again, with the workgroups in words(). Leaves STORAGE and COMMAND barriers.
  /// @param list  of the phase that is drawn next; it is not built yet   @param view  of the frame, with a budget
  void limit(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view, const DrawList& list);
  /// Moves the price for the next frame. Leaves a UNIFORM barrier. @param list  as limit
  void movePrice(const ObjectBuffers& decided, const DrawList& list);

  /// Workgroups as glDispatchComputeIndirect takes them, at an offset of kBudgetCellGroups words: 0 within the budget.
  const gl::Buffer& words() const { return objects_.budget; }

 private:
  void clear(bool second);
  void sum(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view);
  void run(const gl::Program& program, const SceneBindings& scene, const ObjectBuffers& decided) const;

  ObjectStore& objects_;
  gl::Program sumProgram_;
  std::optional<gl::Program> sumCellsProgram_;
  gl::Program planProgram_;
  gl::Program forecastProgram_;
  gl::Program limitProgram_;
  gl::Program moveProgram_;
};

}  // namespace jalousie::visibility
