// Scene, camera and occluding depth of scaling_bench, and the copy pass that its figures are compared with.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/handle.h"
#include "gl/texture.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "shared/frame_structs.h"

namespace jalousie::bench {

inline constexpr std::uint32_t kScalingWidth = 1280;
inline constexpr std::uint32_t kScalingHeight = 720;

/// `count` spheres of many sizes with ten levels in a cube, some mirrored.
scene::SceneData makeScalingScene(std::uint32_t count);

/// A camera that sees about half of the objects.
scene::Camera scalingCamera(const scene::SceneData& scene);

/// Depth of a perforated wall through the middle of the cube.
gl::Texture makeWallDepth(const scene::SceneData& scene);

/// Two-phase culling and levels by pixel error.
gpu::CullView scalingView(const scene::SceneData& scene, std::uint32_t mapLevels);

/// Copies the objects' transforms, one thread per object: the least that a pass over all objects can cost.
class CopyPass {
 public:
  /// Keeps a reference to source, gpu::Transform [count].
  CopyPass(const gl::Buffer& source, std::uint32_t count);
  void run() const;
  /// Whether the target holds the source's bytes. Waits for the GPU.
  bool isRight() const;

 private:
  const gl::Buffer& source_;
  std::uint32_t count_;
  gl::Buffer target_;
  gl::Handle<gl::ProgramTraits> program_;
};

}  // namespace jalousie::bench
