// Time per pass of a frame.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <vector>

#include "gl/debug_log.h"
#include "gl/handle.h"

namespace jalousie::gl {

struct PassTime {
  std::string_view name;  ///< a string literal
  double ms = 0.0;
};

/// How passes are timed.
enum class Timing {
  kOff,   ///< not timed; only the debug groups are opened
  kWall,  ///< wall time between glFinish calls around each pass: right on a software renderer, too
  kGpu,   ///< timestamps on the GPU; passes overlap as they do without a timer
};

/// Opens a debug group per pass and times it. No allocation after the first timed frame.
class PassTimer {
 public:
  static constexpr std::size_t kMaxPasses = 32;

  PassTimer() { passes_.reserve(kMaxPasses); }
  PassTimer(const PassTimer&) = delete;
  PassTimer& operator=(const PassTimer&) = delete;
  ~PassTimer();

  void setTiming(Timing timing) { timing_ = timing; }
  /// Removes the passes of the last frame.
  void beginFrame() { passes_.clear(); }
  /// Passes of the frame in order of their start. With kGpu this call waits for the GPU. Passes beyond kMaxPasses are
  /// not timed.
  const std::vector<PassTime>& passes();

  /// One pass, from construction to destruction.
  class Scope {
   public:
    Scope(PassTimer& timer, const char* name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PassTimer& timer_;
    DebugGroup group_;
    bool timed_;
    std::size_t index_ = 0;
    std::chrono::steady_clock::time_point start_;
  };

 private:
  Timing timing_ = Timing::kOff;
  std::vector<PassTime> passes_;
  std::array<GLuint, 2 * kMaxPasses> queries_{};  ///< start and end of each pass; created by the first timed one
};

}  // namespace jalousie::gl
