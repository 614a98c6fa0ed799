// Wall time between two glFinish calls.
#include "gl/pass_timer.h"

namespace jalousie::gl {

PassTimer::Scope::Scope(PassTimer& timer, const char* name) : timer_(timer), group_(name), name_(name) {
  if (!timer_.enabled_) return;
  glFinish();
  start_ = std::chrono::steady_clock::now();
}

PassTimer::Scope::~Scope() {
  if (!timer_.enabled_) return;
  glFinish();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
  timer_.passes_.push_back({name_, elapsed.count()});
}

}  // namespace jalousie::gl
