// Draws a decided frame: the objects, and what the debug view shows of them.
#pragma once

#include "policy/traits.h"
#include "render/debug_views.h"
#include "render/frame_options.h"
#include "render/methods/cull_method.h"

namespace jalousie::render {

/// Draws frames of one renderer. Borrows the context.
class FrameDrawing {
 public:
  /// Builds the programs of the debug views. Errors: kShader.
  FrameDrawing(const FrameContext& frame, const scene::SceneData& scene, const gl::ShaderLibrary& shaders)
      : frame_(frame), views_(scene, shaders) {}

  /// Draws what the method decided, and counts visible pixels where the context says so.
  void draw(const FrameOptions& options, CullMethod& method);
  /// Draws the object numbers of the last frame into Targets::ids.
  void drawIds() const;
  /// Draws over them what the frame left out.
  void drawLeftOutIds();
  /// Forgets what depends on the size of the screen.
  void resize() { views_.resize(); }

 private:
  bool twoPhases() const { return has(frame_.cullView.traits, gpu::kTraitTwoPhases); }
  void countPixels(bool opaqueIsThere) const;
  /// @param earlyIsThere  what the first phase drew @param lateIsThere  opaque surfaces of the late list
  void drawObjects(const gl::Framebuffer& target, bool earlyIsThere, bool lateIsThere) const;
  void drawView(const FrameOptions& options, bool frozen);
  DrawnFrame drawnFrame() const;

  const FrameContext& frame_;
  DebugViews views_;
};

}  // namespace jalousie::render
