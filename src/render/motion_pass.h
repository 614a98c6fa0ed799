// Plays animations: moves objects, bends vertices, and fits boxes to them.
#pragma once

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/scene_buffers.h"
#include "scene/motion_data.h"
#include "shared/motion_structs.h"

namespace jalousie::render {

/// The kernels of shaders/motion, and what they read. CPU twin: scene::poseScene.
class MotionPass {
 public:
  /// Copies the arrays to the GPU. Errors: kLimit if the driver's buffers cannot hold them; kShader.
  MotionPass(const scene::MotionData& motion, const gl::ShaderLibrary& shaders);

  /// Gives the scene the pose of a time; does nothing if it has it already.
  /// @param seconds  before the first key and after the last one of a property, it has their values
  void play(float seconds, SceneBuffers& scene);
  /// The next play() writes the pose anew: something else has written transforms.
  void forget() { played_.reset(); }

 private:
  void moveNodes();
  void moveTargets(SceneBuffers& scene);
  void bendVertices(const SceneBuffers& scene);
  void boundPoses(const SceneBuffers& scene);

  gpu::MotionView view_;
  std::size_t firstVertexByte_;
  std::size_t vertexBytes_;
  std::optional<float> played_;  ///< the time of the pose that the scene has
  gl::Program moveNodes_;
  gl::Program moveTargets_;
  gl::Program bendVertices_;
  gl::Program boundPoses_;
  gl::Buffer viewBuffer_;
  gl::Buffer numbers_;
  gl::Buffer tracks_;
  gl::Buffer nodes_;
  gl::Buffer weightTable_;
  gl::Buffer targets_;
  gl::Buffer vertices_;
  gl::Buffer influences_;
  gl::Buffer deltas_;
  gl::Buffer chains_;
  gl::Buffer boxes_;
  gl::Buffer deltaBoxes_;
  gl::Buffer locals_;
  gl::Buffer weights_;
  gl::Buffer joints_;
};

}  // namespace jalousie::render
