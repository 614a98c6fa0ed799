// Draw list of the objects that a frame culled, for the ghost view.
#pragma once

#include "gl/buffer.h"
#include "gl/program.h"
#include "visibility/draw_list_pass.h"

namespace jalousie::visibility {

/// Selects the culled objects or cells of a frame: objects at their coarsest level, cells at that of their object.
/// Allocates its buffers in the constructor.
class GhostPass {
 public:
  /// Keeps a reference to the program of ProgramId::kMarkGhosts, or of kMarkGhostsOfCells if the scene has cells.
  /// Errors: kLimit as DrawList.
  GhostPass(const scene::SceneData& scene, const gl::Program& markProgram);

  /// Fills the list with the objects that the frame does not draw. Leaves the barriers of DrawListPass::build.
  void build(DrawListPass& lists, const SceneBindings& scene, const ObjectBuffers& frame);
  const DrawList& list() const { return list_; }
  /// Buffers for drawing the list.
  ObjectBuffers decided(const ObjectBuffers& frame) const;

 private:
  std::uint32_t objectCount_;
  const gl::Program& markProgram_;
  gl::Buffer states_;
  gl::Buffer marks_;
  DrawList list_;
};

}  // namespace jalousie::visibility
