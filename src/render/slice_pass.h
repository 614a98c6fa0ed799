// A frame drawn in slices: commands at fixed places in the order of a spatial hierarchy, and the marks of what was left
// out (docs/occlusion_queries.md).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "culling/hierarchy.h"
#include "culling/query_options.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "render/draw_pass.h"
#include "scene/scene_data.h"
#include "shared/query_structs.h"
#include "visibility/face_pass.h"
#include "visibility/pass_bindings.h"

namespace jalousie::render {

/// Places of objects, and of what is drawn of them, in the order of a hierarchy.
struct SliceOrder {
  std::vector<gpu::uint> objects;        ///< [objects] by place
  std::vector<gpu::uint> units;          ///< [cells, or objects where there are none] by place
  std::vector<std::uint32_t> firstUnit;  ///< [objects + 1] place of an object's first unit
  std::vector<gpu::uint> leafOf;         ///< [objects] by place: leaf of the hierarchy
  std::vector<std::uint32_t> placeOf;    ///< [objects] by index of the object

  /// Allocates nothing where it has held as many before. @param tree  over the objects of the scene
  void follow(const scene::SceneData& scene, const culling::SpatialHierarchy& tree);
  /// The units of a range of objects.
  SlicePlaces unitsOf(std::uint32_t firstObject, std::uint32_t count) const {
    return {firstUnit[firstObject], firstUnit[firstObject + count] - firstUnit[firstObject]};
  }
};

/// Ranges of indices that each place may have where groups of back faces are culled; 0 without groups.
/// @param mostGroups  of one level   @param units  with a place each
std::uint32_t sliceRanges(std::uint32_t mostGroups, std::uint32_t units);

/// What culls groups of back faces of the slices.
struct SliceFaces {
  visibility::FacePass* pass = nullptr;  ///< null: nothing does
  gpu::uint test = gpu::kFacesOff;
};

/// The kernels, and their buffers once they are allocated. CPU twins: visibility::buildSlices, hideObjects.
class SlicePass {
 public:
  /// Errors: kShader.
  explicit SlicePass(const gl::ShaderLibrary& shaders);

  /// Everything for one scene. @param nodes  most nodes of a hierarchy   Errors: kLimit.
  void allocate(const scene::SceneData& scene, std::uint32_t nodes);
  void setOrder(const SliceOrder& order);

  /// Writes the commands of a frame that was classified.
  void begin(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
             const culling::QueryOptions& options, const SliceFaces& faces = {});
  /// For programs that read gpu::SliceView.
  void bindView() const { viewBuffer_.bindUniform(gpu::kBindingSliceView); }
  /// What begin() wrote. @param fading  levels may fade out
  SliceList list(bool fading) const {
    const std::uint32_t each = std::max(view_.faceCommands, 1U);
    return {&instances_, &commands(), view_.commandCapacity * each, each, patches_, fading};
  }
  /// gpu::uint [nodes]: samples of the nodes whose answers the CPU does not see; the caller writes them in this frame.
  const gl::Buffer& samples() {
    samplesWritten_ = true;
    return samples_;
  }
  /// Empties the commands of ranges whose samples are too few. Writes the ranges to the GPU. @pre at most kMostRanges
  void dropHidden(std::span<const gpu::SliceRange> ranges);
  /// Corrects marks and verdicts. @param drawn  [(objects + 31) / 32] bits by place
  void hide(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
            std::span<const std::uint32_t> drawn);

  /// The same for a frame that is not drawn in slices: nothing but the bits decides. No begin() is needed.
  /// @param notHidden  as drawn of hide()
  void hideKnown(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
                 std::span<const std::uint32_t> notHidden);

  static constexpr std::uint32_t kMostRanges = 8192;

 private:
  /// Where the opaque surfaces of the frame are.
  const gl::Buffer& commands() const { return view_.faceCommands > 0 ? faceCommands_ : commands_; }
  /// Writes the view, and makes all samples unknown.
  void prepare(const culling::QueryOptions& options);

  gl::Program sliceCommands_;
  gl::Program dropHidden_;
  gl::Program hideObjects_;
  gl::Program hideCells_;
  gpu::SliceView view_{};
  std::uint32_t cellCount_ = 0;
  std::uint32_t faceRanges_ = 0;  ///< of a place; 0: the scene has no groups
  bool patches_ = false;
  bool samplesWritten_ = true;  ///< not cleared to kSamplesUnknown since they were written or made
  gl::Buffer viewBuffer_;
  gl::Buffer objectOrder_;
  gl::Buffer unitOrder_;
  gl::Buffer leafOf_;
  gl::Buffer commands_;
  gl::Buffer faceCommands_;  ///< those of SliceFaces; empty if the scene has no groups
  gl::Buffer instances_;
  gl::Buffer samples_;
  gl::Buffer ranges_;
  gl::Buffer drawnBits_;
};

}  // namespace jalousie::render
