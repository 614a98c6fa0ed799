// What a frame left out, as a list that can be drawn.
#pragma once

#include "gl/buffer.h"
#include "gl/program.h"
#include "visibility/draw_list_pass.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {

/// Marks the culled objects of a frame at their coarsest level. Its buffers are as long as the pass is in use.
class GhostPass {
 public:
  /// Keeps a reference to the program of ProgramId::kMarkGhosts. Errors: kLimit as DrawList.
  GhostPass(const scene::SceneData& scene, const gl::Program& markProgram);

  /// Fills the list with what the frame's decisions leave out. Leaves the barriers of DrawListPass::build.
  void build(DrawListPass& lists, const SceneBindings& scene, const VisibilityPass& visibility);
  const DrawList& list() const { return list_; }
  /// States and marks of the ghosts; view and boxes are the frame's.
  ObjectBuffers decided(const VisibilityPass& visibility) const;

 private:
  std::uint32_t objectCount_;
  const gl::Program& markProgram_;
  gl::Buffer states_;
  gl::Buffer marks_;
  DrawList list_;
};

}  // namespace jalousie::visibility
