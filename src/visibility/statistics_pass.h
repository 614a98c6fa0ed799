// Statistics of past frames without waiting: the GPU copies them into mapped memory, the CPU reads them once a fence
// has been signalled.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/face_structs.h"
#include "visibility/draw_list_pass.h"
#include "visibility/frame_counters.h"

namespace jalousie::visibility {

/// Statistics of one frame.
struct FrameRecord {
  std::uint64_t frame = 0;  ///< counted from 1
  gpu::CullView view{};
  FrameCounters counters{};
  std::array<gpu::uint, gpu::kDrawCounts> early{};        ///< draw counts of the first list
  std::array<gpu::uint, gpu::kDrawCounts> late{};         ///< and of the second
  std::array<gpu::uint, gpu::kFaceFigures> earlyFaces{};  ///< figures of back faces of the first list
  std::array<gpu::uint, gpu::kFaceFigures> lateFaces{};   ///< and of the second
};

/// Has three slots: the statistics of a frame arrive at most two frames later unless the GPU is further behind. A frame
/// whose slot is still in flight is not recorded. CPU twin of the counting: countStates.
class StatisticsPass {
 public:
  explicit StatisticsPass(const gl::ShaderLibrary& shaders = {});
  ~StatisticsPass();
  StatisticsPass(const StatisticsPass&) = delete;
  StatisticsPass& operator=(const StatisticsPass&) = delete;

  /// Counts the frame and copies the result.
  /// @param view  of the frame   @param early, late  its lists, built; early may be null if it draws nothing into the
  /// frame
  void endFrame(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                const DrawList* early, const DrawList& late);
  /// FrameRecord::frame of the last endFrame().
  std::uint64_t frame() const { return frame_; }
  /// The newest statistics that have arrived; empty until the first do. Never waits.
  const std::optional<FrameRecord>& latest();
  /// Waits for the statistics of the last frame.
  const std::optional<FrameRecord>& finish();

 private:
  struct Slot {
    std::uint64_t frame = 0;
    gpu::CullView view{};
    GLsync fence = nullptr;
  };
  bool collect(Slot& slot, std::size_t index, std::uint64_t timeoutNs);

  void count(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view, const DrawList* early,
             const DrawList& late);
  void countCells(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                  const DrawList& list) const;

  gl::Program countProgram_;
  gl::Program countCellsProgram_;
  gl::Program countStatesOfCellsProgram_;
  gl::Buffer counters_;
  gl::Buffer mapped_;
  const gpu::uint* memory_ = nullptr;
  std::array<Slot, 3> slots_;
  std::uint64_t frame_ = 0;
  std::optional<FrameRecord> latest_;
};

}  // namespace jalousie::visibility
