// Time per pass of a frame.
#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "gl/debug_log.h"

namespace jalousie::gl {

struct PassTime {
  std::string_view name;  ///< a string literal
  double wallMs = 0.0;
};

/// Opens a debug group per pass and, if enabled, brackets it with glFinish and wall time: the only timing that tells
/// the truth on a software renderer. Disabled, it costs nothing but the debug groups. No allocation after the first
/// frame.
class PassTimer {
 public:
  explicit PassTimer(bool enabled = false) : enabled_(enabled) { passes_.reserve(16); }

  void setEnabled(bool enabled) { enabled_ = enabled; }
  /// Forgets the last frame's passes.
  void beginFrame() { passes_.clear(); }
  const std::vector<PassTime>& passes() const { return passes_; }

  /// One pass; ends when destroyed.
  class Scope {
   public:
    Scope(PassTimer& timer, const char* name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PassTimer& timer_;
    DebugGroup group_;
    std::string_view name_;
    std::chrono::steady_clock::time_point start_;
  };

 private:
  bool enabled_;
  std::vector<PassTime> passes_;
};

}  // namespace jalousie::gl
