// Figures of past frames without waiting: copied into mapped memory and picked up when the GPU is done with them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "visibility/draw_list_pass.h"
#include "visibility/frame_counters.h"

namespace jalousie::visibility {

/// What one frame left behind.
struct FrameRecord {
  std::uint64_t frame = 0;  ///< counted from 1
  gpu::CullView view{};
  FrameCounters counters{};
  std::array<gpu::uint, gpu::kDrawCounts> early{};  ///< draw counts of the first list
  std::array<gpu::uint, gpu::kDrawCounts> late{};   ///< and of the second
};

/// Three slots: a frame's figures arrive at the latest two frames later on a GPU that keeps up. A frame whose slot is
/// still in flight goes uncounted instead of waiting. CPU twin of the counting: countStates.
class StatisticsPass {
 public:
  explicit StatisticsPass(const gl::ShaderLibrary& shaders = {});
  ~StatisticsPass();
  StatisticsPass(const StatisticsPass&) = delete;
  StatisticsPass& operator=(const StatisticsPass&) = delete;

  /// Counts the frame and copies the figures. @param early, late  the frame's lists; early may be unused (null)
  void endFrame(const SceneBindings& scene, const VisibilityPass& visibility, const gpu::CullView& view,
                const DrawList* early, const DrawList& late);
  /// The newest figures that have arrived; none before the first have. Never waits.
  const std::optional<FrameRecord>& latest();
  /// Waits for the last frame's figures.
  const std::optional<FrameRecord>& finish();

 private:
  struct Slot {
    std::uint64_t frame = 0;
    gpu::CullView view{};
    GLsync fence = nullptr;
  };
  bool collect(Slot& slot, std::size_t index, std::uint64_t timeoutNs);

  gl::Program countProgram_;
  gl::Buffer counters_;
  gl::Buffer mapped_;
  const gpu::uint* memory_ = nullptr;
  std::array<Slot, 3> slots_;
  std::uint64_t frame_ = 0;
  std::optional<FrameRecord> latest_;
};

}  // namespace jalousie::visibility
