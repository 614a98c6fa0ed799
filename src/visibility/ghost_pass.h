// Draw list of the objects that a frame culled, for the ghost view.
#pragma once

#include "gl/buffer.h"
#include "gl/program.h"
#include "visibility/draw_list_pass.h"

namespace jalousie::visibility {

/// Selects the culled objects of a frame, at their coarsest level. Allocates its buffers in the constructor.
class GhostPass {
 public:
  /// Keeps a reference to the program of ProgramId::kMarkGhosts. Errors: kLimit as DrawList.
  GhostPass(const scene::SceneData& scene, const gl::Program& markProgram);

  /// Fills the list with the objects that the frame does not draw. Leaves the barriers of DrawListPass::build.
  void build(DrawListPass& lists, const SceneBindings& scene, const ObjectBuffers& frame);
  const DrawList& list() const { return list_; }
  /// Buffers for drawing the list: states and marks of its own, view and boxes of the frame.
  ObjectBuffers decided(const ObjectBuffers& frame) const;

 private:
  std::uint32_t objectCount_;
  const gl::Program& markProgram_;
  gl::Buffer states_;
  gl::Buffer marks_;
  DrawList list_;
};

}  // namespace jalousie::visibility
