// One frame, start to end: the order of the passes and the targets they write.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/image.h"
#include "gl/framebuffer.h"
#include "gl/pass_timer.h"
#include "render/draw_pass.h"
#include "render/frame_statistics.h"
#include "render/scene_buffers.h"
#include "scene/camera.h"
#include "visibility/visibility_pass.h"

namespace jalousie::render {

/// What to draw and how to decide it. Values are those of shared/frame_structs.h.
struct FrameOptions {
  gpu::uint cullMode = gpu::kCullHom;
  gpu::uint lodRule = gpu::kLodLinear;
  gpu::uint detail = gpu::kDetailDiscrete;
  gpu::uint view = gpu::kViewShaded;
  /// Finest level of the patch path; lowered to tessellationLimit() where the driver would lose triangles.
  gpu::uint maxTessellation = gpu::kMaxTessellationLevel;
  gpu::uint mapLevel = 0;  ///< level shown by kViewOcclusion
  /// World units; objects nearer than this are occluders. Absent: automaticOccluderDistance().
  std::optional<float> occluderDistance;
  float cullThreshold = 1.0F;  ///< opacity from which a texel hides; below 1 is not conservative
  bool skipDraw = false;       ///< run the visibility passes only: statistics without a picture
};

/// Distance to the scene's box plus kOccluderDepth of its diagonal: the front layer of objects, from outside and
/// inside.
float automaticOccluderDistance(const glm::vec3& eyeWorld, const Aabb& sceneWorld);

/// Renders frames of one scene at one size. The frame path allocates nothing and reads nothing back.
class FrameRenderer {
 public:
  /// Keeps a reference to scene, which must outlive the renderer.
  FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height);

  /// Culls and chooses detail from cullCamera, draws from drawCamera (usually the same).
  void render(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera) noexcept;

  // After the frame; each waits for the GPU.
  ImageRgba8 readImage() const { return target_.readRgba8(width_, height_); }
  FrameStatistics readStatistics() const;
  std::vector<gpu::ObjectState> readStates() const;
  std::vector<gpu::ScreenRect> readRects() const;
  std::vector<gpu::DrawCommand> readCommands() const;

  gl::PassTimer& timer() { return timer_; }
  const gpu::CullView& cullView() const { return cullView_; }
  const visibility::OcclusionMapPass& map() const { return map_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  void setViews(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera);
  void drawOccluders();
  void drawFrame(const FrameOptions& options);

  const scene::SceneData& scene_;
  std::uint32_t width_;
  std::uint32_t height_;
  gpu::uint tessellationLimit_;
  SceneBuffers buffers_;
  visibility::OcclusionMapPass map_;
  visibility::VisibilityPass visibility_;
  DrawPass draw_;
  gl::Texture color_;
  gl::Texture depth_;
  gl::Framebuffer target_;
  gl::PassTimer timer_;
  gpu::CullView cullView_{};
  gpu::DrawView drawView_{};
};

}  // namespace jalousie::render
