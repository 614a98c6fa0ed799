// Time per pass of a frame.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "core/timing.h"
#include "gl/debug_log.h"
#include "gl/handle.h"

namespace jalousie::gl {

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
