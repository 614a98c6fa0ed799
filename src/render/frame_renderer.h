// One frame, start to end: the order of the passes and the targets they write.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/image.h"
#include "core/timing.h"
#include "render/frame_options.h"
#include "render/frame_statistics.h"
#include "shared/frame_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::gl {
class Buffer;
class Texture;
}  // namespace jalousie::gl
namespace jalousie::scene {
struct Camera;
struct SceneData;
}  // namespace jalousie::scene
namespace jalousie::visibility {
class DepthPyramidPass;
class DrawList;
class OcclusionMapPass;
}  // namespace jalousie::visibility

namespace jalousie::render {

struct FrameParts;

/// What the last frame decided about one object.
struct ObjectReadout {
  gpu::ObjectState state{};
  gpu::ScreenBox box{};
  gpu::uint marks = 0;   ///< kMark...
  gpu::uint pixels = 0;  ///< visible when pixels were last counted
};

/// Renders frames of one scene at one size: classify, let the mode's method decide, build the draw list, draw, count.
/// The frame path reads nothing back and allocates nothing, except on the first frame of a debug view or mode that
/// needs memory of its own, and where the row of the mode says that it reads back (CullModeRow::readsBack).
class FrameRenderer {
 public:
  /// Keeps a reference to scene, which must outlive the renderer.
  /// Errors: kLimit if RendererOptions::memory is not enough, or if the driver's buffers and textures cannot hold the
  /// scene or the picture; kShader.
  FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height,
                const RendererOptions& options = {});
  ~FrameRenderer();
  FrameRenderer(FrameRenderer&&) noexcept;
  FrameRenderer& operator=(FrameRenderer&&) noexcept;

  /// Makes what the mode of these options needs of its own: for modes with occlusion queries a spatial hierarchy and
  /// buffers in its order. render() does the same on the first frame of a mode, but must not fail. Errors: kLimit.
  void prepare(const FrameOptions& options);

  /// Culls and chooses detail from cullCamera, draws from drawCamera (usually the same).
  void render(const FrameOptions& options, const scene::Camera& cullCamera, const scene::Camera& drawCamera) noexcept;
  /// Draws again what the last frame's occlusion test compared objects with, from the culling camera: readDepth() and
  /// map() then hold the occluders. The picture is lost. Does nothing in modes without such a test.
  void renderCover() noexcept;
  /// Draws the last frame's objects again, as object numbers.
  void renderIds() noexcept;
  /// Draws over the last renderIds() what the frame left out and what lies in front of it there: objects at their
  /// coarsest level, cells at the level of their object. Of a frame that loses nothing, no number changes.
  void renderLeftOutIds() noexcept;

  /// Another size; history is forgotten. Errors: kLimit, as the constructor; the renderer can then only be destroyed or
  /// resized. @pre both sides in [1, 16384] (checked)
  void resize(std::uint32_t width, std::uint32_t height);
  /// Moves objects: rewrites the transforms [first, first + transforms.size()) of SceneData::transforms. An index is
  /// that of a transform (gpu::Object::transform), not of an object. @pre in range (checked)
  void setTransforms(std::uint32_t first, std::span<const gpu::Transform> transforms);
  /// gpu::Transform [SceneData::transforms.size()], for applications that write it on the GPU.
  gl::Buffer& transforms();
  /// Forgets what was visible: the next frame decides as if it were the first.
  void resetHistory();

  /// The newest figures that have arrived, at the latest two frames late on a GPU that keeps up. Never waits.
  std::optional<FrameStatistics> latestStatistics();

  // After the frame; each waits for the GPU.
  FrameStatistics readStatistics();
  ImageRgba8 readImage() const;
  std::vector<float> readDepth() const;
  /// Object index + 1 per pixel, 0 for the background, row 0 at the bottom; of the last renderIds().
  std::vector<std::uint32_t> readIds() const;
  /// @pre index < objectCount (checked)
  ObjectReadout readObject(std::uint32_t index) const;
  /// World box of an object, where animations have taken it. @pre index < objectCount (checked)
  Aabb readBounds(std::uint32_t index) const;
  std::vector<gpu::ObjectState> readStates() const;
  std::vector<gpu::ScreenBox> readBoxes() const;
  std::vector<gpu::uint> readMarks() const;
  /// Visible pixels of each object; of frames with LvMeasure::kPixels.
  std::vector<gpu::uint> readPixelCounts() const;

  /// How the passes of the next frames are timed; off at first.
  void setTiming(Timing timing);
  /// Times of the last frame's passes, in order; with Timing::kGpu it waits for them.
  const std::vector<PassTime>& passTimes();
  /// The frame's picture, GL_SRGB8_ALPHA8, row 0 at the bottom.
  const gl::Texture& color() const;
  const gpu::CullView& cullView() const;
  const visibility::OcclusionMapPass& map() const;
  const visibility::DepthPyramidPass& pyramid() const;
  const visibility::DrawList& earlyList() const;
  const visibility::DrawList& lateList() const;
  std::uint32_t width() const;
  std::uint32_t height() const;

 private:
  std::unique_ptr<FrameParts> parts_;
};

}  // namespace jalousie::render
