// One frame, start to end: the order of the passes and the targets they write.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"
#include "gl/framebuffer.h"
#include "gl/pass_timer.h"
#include "render/debug_views.h"
#include "render/draw_pass.h"
#include "render/frame_statistics.h"
#include "render/scene_buffers.h"
#include "scene/camera.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/statistics_pass.h"
#include "visibility/visibility_pass.h"

namespace jalousie::render {

/// Error that the levels in the occlusion map of kCullHomDepth may have, pixels (docs/occlusion_map.md).
inline constexpr float kDefaultOccluderTau = 0.5F;

/// Pixels are counted in one frame of so many: a count serves until the next (docs/level_of_visibility.md).
inline constexpr std::uint32_t kCountInterval = 4;

/// What to draw and how to decide it, frame by frame. Values are those of shared/frame_structs.h.
struct FrameOptions {
  gpu::uint cullMode = gpu::kCullHiz;
  gpu::uint lodRule = gpu::kLodLvError;
  gpu::uint detail = gpu::kDetailDiscrete;
  gpu::uint view = gpu::kViewShaded;
  float tau = 1.0F;  ///< error allowed on the screen, pixels; what is hidden may have more (kLodLvError)
  gpu::uint lvMeasure = gpu::kLvPixels;
  float relax = 64.0F;  ///< kLodLvError: tau grows to at most tau * (1 + relax)
  /// For what moves: levels keep within a margin of the budget, change one at a time and are cross-faded, and LV is
  /// smoothed. Off, levels follow from the frame (and with kLvPixels from the last count) alone: for captures.
  bool calm = false;
  float hysteresis = gpu::kDefaultHysteresis;      ///< calm: a level stays while tau times and over this allow it; >= 1
  gpu::uint fadeFrames = gpu::kDefaultFadeFrames;  ///< calm: frames of a cross-fade, <= kMaxFadeFrames; 0: none
  /// Objects whose rectangle covers fewer pixels are not drawn; 0: all are.
  float minPixels = 0.0F;
  /// Finest level of the patch path; lowered to tessellationLimit() where the driver would lose triangles.
  gpu::uint maxTessellation = gpu::kMaxTessellationLevel;
  gpu::uint mapLevel = 0;  ///< level shown by kViewOcclusion
  bool boxes = false;      ///< outline every object's rectangle; nothing where the culling camera is frozen
  /// World units; objects nearer than this are occluders. Absent: automaticOccluderDistance().
  std::optional<float> occluderDistance;
  /// Error that levels drawn into the occlusion map may have, pixels. Absent: LOD 0 with kCullHom, as in the thesis,
  /// kDefaultOccluderTau with kCullHomDepth.
  std::optional<float> occluderTau;
  float cullThreshold = 1.0F;  ///< opacity from which a texel hides; below 1 is not conservative
  bool skipDraw = false;       ///< leave out what only the picture needs: statistics without a picture
};

/// What a renderer allocates and which paths it takes.
struct RendererOptions {
  visibility::Submission submission = visibility::Submission::kInstanced;
  bool fastPaths = true;  ///< use extensions where the driver has them; the results are the same
  /// Most instances one draw list holds; absent: all objects. What finds no room is not drawn, counted and reported.
  std::optional<std::uint32_t> capacity = {};
  /// Scales tau and minPixels by region; only read by the constructor. May be null.
  const visibility::ImportanceMask* importance = nullptr;
};

/// Distance to the scene's box plus kOccluderDepth of its diagonal: the front layer of objects, from outside and
/// inside.
float automaticOccluderDistance(const glm::vec3& eyeWorld, const Aabb& sceneWorld);

/// What the last frame decided about one object.
struct ObjectReadout {
  gpu::ObjectState state{};
  gpu::ScreenBox box{};
  gpu::uint marks = 0;
  gpu::uint pixels = 0;  ///< that showed it when pixels were counted last
};

/// Renders frames of one scene at one size. The frame path reads nothing back and allocates nothing, but on the first
/// frame of a debug view that needs memory of its own.
class FrameRenderer {
 public:
  /// Keeps a reference to scene, which must outlive the renderer.
  /// Errors: kLimit if the driver's buffers cannot hold the scene.
  FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height,
                const RendererOptions& options = {});

  /// Culls and chooses detail from cullCamera, draws from drawCamera (usually the same).
  void render(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera) noexcept;
  /// Draws again what the last frame's test looked at, from the culling camera: readDepth() and map() then hold what
  /// hides. The picture is gone. Nothing happens in modes without such a test.
  void renderCover() noexcept;
  /// Draws the last frame's objects again, as their numbers.
  void renderIds() noexcept;

  /// Another size; history is forgotten. @pre both sides in [1, 16384] (checked)
  void resize(std::uint32_t width, std::uint32_t height);
  /// Moves objects: rewrites the transforms [first, first + transforms.size()) of SceneData::transforms. An index is
  /// that of a transform (gpu::Object::transform), not of an object. @pre in range (checked)
  void setTransforms(std::uint32_t first, std::span<const gpu::Transform> transforms);
  /// gpu::Transform [SceneData::transforms.size()], for applications that write it on the GPU.
  gl::Buffer& transforms() { return buffers_.transforms(); }
  /// Forgets what was visible: the next frame decides as if it were the first.
  void resetHistory() {
    visibility_.resetHistory();
    countAge_ = kCountInterval;
  }

  /// The newest figures that have arrived, at the latest two frames late on a GPU that keeps up. Never waits.
  std::optional<FrameStatistics> latestStatistics();

  // After the frame; each waits for the GPU.
  FrameStatistics readStatistics();
  ImageRgba8 readImage() const { return targets_.frame.readRgba8(width_, height_); }
  std::vector<float> readDepth() const { return targets_.frame.readDepth(width_, height_); }
  /// Object index + 1 per pixel, 0 for the background, row 0 at the bottom; of the last renderIds().
  std::vector<std::uint32_t> readIds() const { return targets_.ids.readRedInteger(width_, height_); }
  /// @pre index < objectCount (checked)
  ObjectReadout readObject(std::uint32_t index) const;
  std::vector<gpu::ObjectState> readStates() const;
  std::vector<gpu::ScreenBox> readBoxes() const;
  std::vector<gpu::uint> readMarks() const;
  /// Pixels that showed each object; of frames whose LV was kLvPixels.
  std::vector<gpu::uint> readPixelCounts() const;

  gl::PassTimer& timer() { return timer_; }
  /// The frame's picture, GL_SRGB8_ALPHA8, row 0 at the bottom.
  const gl::Texture& color() const { return targets_.color; }
  const gpu::CullView& cullView() const { return cullView_; }
  const visibility::OcclusionMapPass& map() const { return map_; }
  const visibility::DepthPyramidPass& pyramid() const { return pyramid_; }
  const visibility::DrawList& earlyList() const { return early_; }
  const visibility::DrawList& lateList() const { return late_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  void setViews(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera);
  void buildList(visibility::DrawList& list, const char* pass);
  void findOccluded(const FrameOptions& options);
  void drawOccluders();
  void drawEarly();
  void drawFrame(const FrameOptions& options);
  void setCullingCamera();
  void beginTarget(const gl::Framebuffer& target);
  void drawView(const FrameOptions& options, bool frozen);
  void drawObjects(const gl::Framebuffer& target, bool earlyIsThere);
  std::optional<FrameStatistics> statisticsOf(const std::optional<visibility::FrameRecord>& record) const;

  /// What depends on the size of the screen alone.
  struct Targets {
    Targets(std::uint32_t width, std::uint32_t height);
    gl::Texture color;
    gl::Texture depth;
    gl::Texture id;
    gl::Framebuffer frame;
    gl::Framebuffer view;  ///< the colour alone: what the depth view draws into while it reads the depth
    gl::Framebuffer ids;
    gl::Framebuffer counted;  ///< the frame, and its object numbers beside it
  };

  const scene::SceneData& scene_;
  std::uint32_t width_;
  std::uint32_t height_;
  gl::Capabilities capabilities_;
  gpu::uint tessellationLimit_;
  FullTriangles fullTriangles_;
  SceneBuffers buffers_;
  Targets targets_;
  visibility::OcclusionMapPass map_;
  visibility::DepthPyramidPass pyramid_;
  visibility::VisibilityPass visibility_;
  visibility::DrawListPass lists_;
  visibility::DrawList early_;
  visibility::DrawList late_;
  visibility::StatisticsPass statistics_;
  DrawPass draw_;
  DebugViews views_;
  gl::PassTimer timer_;
  gpu::CullView cullView_{};
  gpu::DrawView drawView_{};
  bool counting_ = false;                    ///< this frame's pixels are counted
  std::uint32_t countAge_ = kCountInterval;  ///< frames since they last were
};

}  // namespace jalousie::render
