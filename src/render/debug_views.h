// What a debug view adds to a frame that is drawn: lines, overdraw, ghosts, rectangles.
#pragma once

#include <cstdint>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "render/draw_pass.h"
#include "render/scene_buffers.h"
#include "visibility/ghost_pass.h"
#include "visibility/program_table.h"

namespace jalousie::render {

/// The frame as the views build on it. Borrows everything.
struct DrawnFrame {
  gpu::DrawView view{};                          ///< the drawing camera
  bool twoPhases = false;                        ///< both lists were drawn, else the late one alone
  const gl::Framebuffer* target = nullptr;       ///< colour and depth
  const gl::Framebuffer* colorTarget = nullptr;  ///< colour alone
  const visibility::DrawList* early = nullptr;
  const visibility::DrawList* late = nullptr;
  const visibility::VisibilityPass* visibility = nullptr;
};

/// Allocates on the first frame of a view that needs memory of its own, and nothing for the others.
class DebugViews {
 public:
  /// Builds every program: a shader that does not build must not be found during a frame. Errors: kShader.
  explicit DebugViews(const scene::SceneData& scene, const gl::ShaderLibrary& shaders = {})
      : scene_(scene),
        markGhosts_(visibility::programSource(scene.cells.objects.empty() ? visibility::ProgramId::kMarkGhosts
                                                                          : visibility::ProgramId::kMarkGhostsOfCells),
                    shaders) {}

  /// Draws over the frame what its view asks for; GL_FRAMEBUFFER_SRGB is on.
  void draw(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers, visibility::DrawListPass& lists);
  /// Draws what the frame left out as object numbers, into the bound framebuffer.
  void drawLeftOut(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers, visibility::DrawListPass& lists);
  /// Forgets what depends on the size of the screen.
  void resize() { halvings_.reset(); }

 private:
  struct Halvings {
    Halvings(std::uint32_t width, std::uint32_t height);
    gl::Texture texture;
    gl::Framebuffer framebuffer;
  };
  void drawLines(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers);
  void drawOverdraw(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers);
  /// Draws the frame again, from an empty picture.
  void drawDensity(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers);
  void drawGhosts(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers, visibility::DrawListPass& lists);
  /// Builds the list of what the frame left out. @return  the buffers for drawing it
  visibility::ObjectBuffers buildGhosts(const DrawnFrame& frame, SceneBuffers& buffers,
                                        visibility::DrawListPass& lists);

  const scene::SceneData& scene_;
  std::optional<Halvings> halvings_;
  gl::Program markGhosts_;
  std::optional<visibility::GhostPass> ghosts_;
};

}  // namespace jalousie::render
