// The kernels that decide, per object: classify and analyse; and the buffers they fill.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "shared/frame_structs.h"
#include "shared/scene_structs.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/importance_mask.h"
#include "visibility/occlusion_map_pass.h"

namespace jalousie::visibility {

/// The scene's buffers, owned by the caller, bound as long as a pass runs.
struct SceneBindings {
  const gl::Buffer* transforms = nullptr;  ///< gpu::Transform [objectCount]
  const gl::Buffer* objects = nullptr;     ///< gpu::Object [objectCount]
  const gl::Buffer* chains = nullptr;      ///< gpu::Chain
  const gl::Buffer* lods = nullptr;        ///< gpu::Lod
};

/// What a frame decided per object, as lists and draws read it.
struct ObjectBuffers {
  const gl::Buffer* view = nullptr;    ///< gpu::CullView
  const gl::Buffer* states = nullptr;  ///< gpu::ObjectState [objectCount]
  const gl::Buffer* boxes = nullptr;   ///< gpu::ScreenBox [objectCount]
  const gl::Buffer* marks = nullptr;   ///< kMark... [objectCount]
};

/// What the overlap test looks at; which of them depends on the traits of the mode.
struct CoverTextures {
  const OcclusionMapPass* map = nullptr;      ///< with kTraitUsesMap
  const DepthPyramidPass* pyramid = nullptr;  ///< with kTraitUsesDepth
  const gl::Texture* depth = nullptr;         ///< level 0 of the pyramid
};

/// Decides, for every object and without a read-back, whether it is drawn, when, and how finely.
/// Call order per frame: setView, classify, [draw what is marked early, build map or pyramid, analyse].
class VisibilityPass {
 public:
  /// Allocates every buffer for objectCount objects; nothing is allocated later.
  explicit VisibilityPass(std::uint32_t objectCount, const ImportanceMask* importance = nullptr);

  /// Uploads camera and policy for the kernels; fills in the importance mask's size.
  /// @pre view.objectCount equals the constructor's (checked)
  void setView(gpu::CullView view);
  /// Verdict, screen box, phase and first detail of every object. Leaves a STORAGE barrier.
  void classify(const SceneBindings& scene);
  /// Overlap test and LV of the objects that classify left pending. Leaves a STORAGE barrier.
  /// @param traits  gpu::CullView::traits, with kTraitUsesMap, kTraitUsesDepth or both
  void analyse(const SceneBindings& scene, gpu::uint traits, const CoverTextures& cover);
  /// Counts the pixels that show each object, for the LV of the next frames (kTraitLvPixels). Call after the frame is
  /// drawn.
  /// @param items  GL_R32UI, object index + 1 per pixel, 0 for none. Leaves a STORAGE barrier.
  void countPixels(const gl::Texture& items);
  /// Forgets what was visible in the last frame.
  void resetHistory() { marks_.clear(); }

  std::uint32_t objectCount() const { return objectCount_; }
  ObjectBuffers decided() const { return {&view_, &states_, &boxes_, &marks_}; }
  const gl::Buffer& view() const { return view_; }                ///< gpu::CullView
  const gl::Buffer& states() const { return states_; }            ///< gpu::ObjectState [objectCount]
  const gl::Buffer& boxes() const { return boxes_; }              ///< gpu::ScreenBox [objectCount]
  const gl::Buffer& marks() const { return marks_; }              ///< kMark... [objectCount]
  const gl::Buffer& pixelCounts() const { return pixelCounts_; }  ///< gpu::uint [objectCount]
  /// For tests that feed the kernels given input.
  gl::Buffer& statesForTest() { return states_; }
  gl::Buffer& boxesForTest() { return boxes_; }
  gl::Buffer& marksForTest() { return marks_; }
  gl::Buffer& pixelCountsForTest(bool countsValid) {
    countsValid_ = countsValid;
    return pixelCounts_;
  }

 private:
  void dispatch(const gl::Program& program, const SceneBindings& scene) const;

  std::uint32_t objectCount_;
  gl::Program classifyProgram_;
  gl::Program analyseMapProgram_;
  gl::Program analyseMapDepthProgram_;
  gl::Program analyseDepthProgram_;
  gl::Program countPixelsProgram_;
  gl::Buffer view_;
  gl::Buffer cosines_;
  gl::Buffer states_;
  gl::Buffer boxes_;
  gl::Buffer marks_;
  gl::Buffer pixelCounts_;
  bool countsValid_ = false;  ///< pixelCounts_ was made in the last frame
  std::optional<gl::Texture> importance_;
  gpu::uint importanceWidth_ = 0;
  gpu::uint importanceHeight_ = 0;
};

}  // namespace jalousie::visibility
