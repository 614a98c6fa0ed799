// A scene on the GPU.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "scene/scene_data.h"
#include "visibility/visibility_pass.h"

namespace jalousie::render {

/// Uploads a scene once; only the transforms, and what animations move, may change afterwards.
class SceneBuffers {
 public:
  /// Errors: kLimit if the driver's buffers or texture arrays cannot hold the scene.
  explicit SceneBuffers(const scene::SceneData& scene);

  std::uint32_t objectCount() const { return objectCount_; }
  std::uint32_t transformCount() const { return transformCount_; }
  /// Array textures that the pictures lie in, 1 to gpu::kTextureClasses.
  std::uint32_t textureClasses() const { return static_cast<std::uint32_t>(textures_.size()); }
  bool usesBlending() const { return usesBlending_; }
  std::uint32_t cellCount() const { return cellCount_; }  ///< 0: objects are drawn whole
  visibility::SceneBindings bindings() const;
  /// gpu::Transform [transformCount]: the application may write it, from the CPU or from a shader, between frames.
  gl::Buffer& transforms() { return transforms_; }
  const gl::Buffer& transforms() const { return transforms_; }
  /// Grows with every change of transforms and boxes that the renderer knows of; of one that anybody may write at any
  /// time, with every call.
  std::uint64_t movement() { return sharesTransforms_ ? ++movement_ : movement_; }
  void noteMovement() { ++movement_; }
  void shareTransforms() { sharesTransforms_ = true; }
  /// Buffers that animations write besides the transforms.
  const gl::Buffer& vertices() const { return vertices_; }
  const gl::Buffer& looseVertices() const { return looseVertices_; }
  const gl::Buffer& chains() const { return chains_; }
  const gl::Buffer& cellChains() const { return cellChains_; }
  const gl::Buffer& cellBounds() const { return cellBounds_; }
  /// Binds vertex input, scene storage and textures for drawing the objects of an instance list.
  void bindForDrawing(const gl::Buffer& instances);
  /// Vertices of segments, and points.
  std::uint32_t looseLineVertices() const { return looseLineVertices_; }
  std::uint32_t loosePoints() const { return loosePoints_; }
  /// Binds vertex input, materials and textures for drawing points and lines: segments first.
  void bindForLoose() const;

 private:
  void bindMaterials() const;

  std::uint32_t objectCount_;
  std::uint32_t transformCount_;
  std::uint32_t cellCount_;
  bool usesBlending_;
  std::uint64_t movement_ = 0;
  bool sharesTransforms_ = false;  ///< the application may write them at any time
  gl::Buffer vertices_;
  gl::Buffer secondUvs_;
  gl::Buffer indices_;
  gl::Buffer transforms_;
  gl::Buffer objects_;
  gl::Buffer chains_;
  gl::Buffer lods_;
  gl::Buffer cells_;
  gl::Buffer cellChains_;
  gl::Buffer cellLods_;
  gl::Buffer cellBounds_;
  gl::Buffer materials_;
  std::vector<gl::Texture> textures_;  ///< by texture class; at least one
  gl::VertexArray vertexArray_;
  std::uint32_t looseLineVertices_;
  std::uint32_t loosePoints_;
  gl::Buffer looseVertices_;
  gl::VertexArray looseArray_;
};

}  // namespace jalousie::render
