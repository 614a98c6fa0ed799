// Draws the command lists: one multi-draw-indirect call per program.
#pragma once

#include <array>
#include <cstdint>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/scene_buffers.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"

namespace jalousie::render {

/// What a draw pass writes.
enum class DrawKind { kShaded, kOpacity };

/// The programs of all lists, and the loop over them.
class DrawPass {
 public:
  DrawPass();

  /// Uploads the drawing camera for all programs.
  void setView(const gpu::DrawView& view);
  /// Draws every list of a detail path with the bound framebuffer. Lists that no object of the scene can fill are
  /// skipped.
  /// @param commands  gpu::DrawCommand [kListCount][objectCount]   @param states  gpu::ObjectState [objectCount]
  void draw(DrawKind kind, gpu::uint detail, const SceneBuffers& scene, const gl::Buffer& commands,
            const gl::Buffer& states) const;
  /// Fills the bound framebuffer with one level of the occlusion map.
  void drawMap(const visibility::OcclusionMapPass& map) const;

 private:
  std::array<gl::Program, gpu::kListCount> shaded_;
  std::array<gl::Program, gpu::kListCount> opacity_;
  gl::Program mapView_;
  gl::VertexArray noInput_;
  gl::Buffer view_;
};

}  // namespace jalousie::render
