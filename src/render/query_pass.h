// Hardware occlusion queries: the device that schedules of src/culling work on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "culling/hierarchy.h"
#include "culling/query_device.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "render/methods/frame_context.h"
#include "render/slice_pass.h"

namespace jalousie::render {

/// How a device leaves out what was hidden without telling the CPU.
enum class DeferredDrawing : std::uint8_t {
  kConditional,  ///< glBeginConditionalRender
  kBuffer,       ///< counts in a buffer (GL_QUERY_BUFFER), which a kernel compares
};

/// Counts samples of boxes, and draws slices. Boxes pass where they are as near as what was drawn, or nearer. They
/// write nothing, and neither side of them is culled.
class QueryPass : public culling::QueryDevice {
 public:
  /// Errors: kShader.
  explicit QueryPass(const gl::ShaderLibrary& shaders);
  ~QueryPass() override;
  QueryPass(const QueryPass&) = delete;
  QueryPass& operator=(const QueryPass&) = delete;

  /// @param nodes  most nodes of a hierarchy
  void allocate(std::uint32_t nodes);
  void setBoxes(const culling::SpatialHierarchy& tree);

  /// Begins a frame: the target is bound and cleared, the slices are written.
  void begin(const FrameContext& frame, SlicePass& slices, const SliceOrder& order, DeferredDrawing deferred);
  /// Draws what is still waiting for it, and leaves the state of a pass that draws.
  void finish();
  /// [(objects + 31) / 32] bits by place: what was drawn in this frame, with a condition or without.
  std::span<const std::uint32_t> drawn() const { return drawnBits_; }
  /// Draw calls of the frame.
  std::uint64_t drawCalls() const { return drawCalls_; }
  std::uint32_t capacity() const override { return kMostQueries; }

 private:
  static constexpr std::uint32_t kMostQueries = 8192;

  Query startQuery(std::span<const std::uint32_t> nodes) override;
  std::uint64_t takeAnswer(Query query) override;
  void drawObjects(std::uint32_t first, std::uint32_t count) override;
  void drawConditionally(std::span<const Conditional> ranges) override;
  void askMode();
  void drawMode();
  void flush();
  void markDrawn(std::uint32_t first, std::uint32_t count);
  void drawPlaces(std::span<const SlicePlaces> places, std::span<const Conditional> conditions = {});

  gl::Program program_;
  gl::Program maskedProgram_;
  gl::VertexArray input_;
  gl::Buffer boxes_;
  std::vector<GLuint> queries_;
  std::vector<Query> free_;
  std::vector<SlicePlaces> waiting_;  ///< to be drawn
  std::vector<SlicePlaces> places_;
  std::vector<gpu::SliceRange> ranges_;
  std::vector<std::uint32_t> drawnBits_;
  std::vector<Aabb> upload_;
  const FrameContext* frame_ = nullptr;
  SlicePass* slices_ = nullptr;
  const SliceOrder* order_ = nullptr;
  DeferredDrawing deferred_ = DeferredDrawing::kConditional;
  bool masked_ = false;  ///< QueryOptions::importance applies
  bool asking_ = false;
  std::uint64_t drawCalls_ = 0;
};

}  // namespace jalousie::render
