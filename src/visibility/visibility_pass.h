// The visibility kernels: classify, analyse, emit; and the buffers they fill.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/frame_structs.h"
#include "shared/scene_structs.h"
#include "visibility/occlusion_map_pass.h"

namespace jalousie::visibility {

/// The scene's buffers, owned by the caller, bound as long as the pass runs.
struct SceneBindings {
  const gl::Buffer* objects = nullptr;  ///< gpu::Object [objectCount]
  const gl::Buffer* chains = nullptr;   ///< gpu::Chain
  const gl::Buffer* lods = nullptr;     ///< gpu::Lod
};

/// Decides, for every object and without a read-back, whether and how finely it is drawn.
/// Call order per frame: setView, classify, [draw occluders, map.reduce, analyse,] emitCommands.
class VisibilityPass {
 public:
  /// Allocates every buffer for objectCount objects; nothing is allocated later.
  explicit VisibilityPass(std::uint32_t objectCount);

  /// Uploads camera and policy for the kernels. @pre view.objectCount equals the constructor's (checked)
  void setView(const gpu::CullView& view);
  /// Frustum and occluder test; with kCullHom also the occluders' draw commands. Leaves COMMAND and STORAGE barriers.
  void classify(const SceneBindings& scene);
  /// Overlap test and LV of the occludees. Leaves a STORAGE barrier.
  void analyse(const SceneBindings& scene, const OcclusionMapPass& map);
  /// Detail and draw commands of every object. Leaves COMMAND and STORAGE barriers.
  void emitCommands(const SceneBindings& scene);

  std::uint32_t objectCount() const { return objectCount_; }
  const gl::Buffer& states() const { return states_; }      ///< gpu::ObjectState [objectCount]
  const gl::Buffer& rects() const { return rects_; }        ///< gpu::ScreenRect [objectCount]
  const gl::Buffer& commands() const { return commands_; }  ///< gpu::DrawCommand [kListCount][objectCount]
  /// For tests that feed the kernels given input.
  gl::Buffer& statesForTest() { return states_; }
  gl::Buffer& rectsForTest() { return rects_; }

 private:
  void dispatch(const gl::Program& program, const SceneBindings& scene, GLbitfield barriers) const;

  std::uint32_t objectCount_;
  gl::Program classifyProgram_;
  gl::Program analyseProgram_;
  gl::Program emitProgram_;
  gl::Buffer view_;
  gl::Buffer cosines_;
  gl::Buffer states_;
  gl::Buffer rects_;
  gl::Buffer commands_;
};

}  // namespace jalousie::visibility
