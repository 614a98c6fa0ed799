// A scene on the GPU.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "scene/scene_data.h"
#include "visibility/visibility_pass.h"

namespace jalousie::render {

/// Uploads a scene once; immutable afterwards.
class SceneBuffers {
 public:
  explicit SceneBuffers(const scene::SceneData& scene);

  std::uint32_t objectCount() const { return objectCount_; }
  bool usesSheets() const { return usesSheets_; }
  visibility::SceneBindings bindings() const { return {&objects_, &chains_, &lods_}; }
  /// Binds vertex input, scene storage and textures for drawing.
  void bindForDrawing() const;

 private:
  std::uint32_t objectCount_;
  bool usesSheets_;
  gl::Buffer vertices_;
  gl::Buffer indices_;
  gl::Buffer objectIds_;  ///< 0, 1, 2, ...: an instanced attribute turns baseInstance into the object id (core 4.5)
  gl::Buffer objects_;
  gl::Buffer chains_;
  gl::Buffer lods_;
  gl::Buffer materials_;
  gl::Texture baseColors_;
  gl::VertexArray vertexArray_;
};

}  // namespace jalousie::render
