// Draw lists on the GPU: the instances of a phase, sorted by chain and level without atomics
// (docs/two_phase_culling.md).
#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "visibility/draw_lists_reference.h"
#include "visibility/pass_bindings.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// One list: instances and the commands that draw them. Everything is allocated once.
class DrawList {
 public:
  /// @param phase  kMarkEarly or kMarkLate: the flag of the objects on the list
  /// Errors: kLimit if the commands exceed the driver's largest storage block.
  DrawList(const scene::SceneData& scene, gpu::uint phase, const DrawListOptions& options);

  const DrawListOptions& options() const { return options_; }
  const gl::Buffer& instances() const { return instances_; }    ///< objects or cells [capacity]
  const gl::Buffer& commands() const { return commands_; }      ///< gpu::DrawCommand [lists][commandCapacity]
  const gl::Buffer& drawCounts() const { return drawCounts_; }  ///< gpu::uint [kDrawCounts]
  /// gpu::uint [2 * objects, or cells]: the slot of each one's instance and of its level that fades out, kNoBin for
  /// none or one that found no room.
  const gl::Buffer& slots() const { return slots_; }
  /// gpu::uint [kFaceFigures]: zeros, unless FacePass has changed the list.
  const gl::Buffer& faceFigures() const { return faceFigures_; }
  std::uint32_t commandCapacity() const { return view_.commandCapacity; }
  const gpu::ListView& view() const { return view_; }
  void bindView(gpu::uint binding) const { viewBuffer_.bindUniform(binding); }

 private:
  friend class DrawListPass;
  DrawListOptions options_;
  gpu::ListView view_;
  gl::Buffer viewBuffer_;
  gl::Buffer instances_;
  gl::Buffer commands_;
  gl::Buffer drawCounts_;
  gl::Buffer slots_;
  gl::Buffer faceFigures_;
};

/// The kernels that fill lists, and their scratch memory. CPU twin: buildDrawLists.
class DrawListPass {
 public:
  /// Errors: kLimit if the driver's storage blocks are too small for the scene.
  explicit DrawListPass(const scene::SceneData& scene, const gl::ShaderLibrary& shaders = {});

  /// Leaves COMMAND, VERTEX_ATTRIB_ARRAY, STORAGE and BUFFER_UPDATE barriers.
  void build(DrawList& list, const SceneBindings& scene, const ObjectBuffers& decided);

 private:
  void bind(const DrawList& list, const SceneBindings& tables, const ObjectBuffers& objects) const;

  std::uint32_t tileCount_;
  bool tilePerThread_;
  std::uint32_t blockCount_;
  gl::Program binProgram_;
  gl::Program scanEntriesProgram_;
  gl::Program scanSumsProgram_;
  gl::Program scatterProgram_;
  gl::Program scatterPerObjectProgram_;
  gl::Program writeCommandsProgram_;
  gl::Program writeCountsProgram_;
  gl::Buffer tiles_;
  gl::Buffer bins_;
  gl::Buffer entries_;
  gl::Buffer blockSums_;
};

}  // namespace jalousie::visibility
