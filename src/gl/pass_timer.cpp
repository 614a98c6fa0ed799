// Wall time between two glFinish calls, or the difference of two timestamps.
#include "gl/pass_timer.h"

namespace jalousie::gl {

PassTimer::~PassTimer() {
  if (queries_[0] != 0) glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

const std::vector<PassTime>& PassTimer::passes() {
  if (timing_ != Timing::kGpu) return passes_;
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    GLuint64 start = 0;
    GLuint64 end = 0;
    glGetQueryObjectui64v(queries_[2 * i], GL_QUERY_RESULT, &start);
    glGetQueryObjectui64v(queries_[2 * i + 1], GL_QUERY_RESULT, &end);
    passes_[i].ms = end > start ? 1e-6 * static_cast<double>(end - start) : 0.0;
  }
  return passes_;
}

PassTimer::Scope::Scope(PassTimer& timer, const char* name)
    : timer_(timer), group_(name), timed_(timer.timing_ != Timing::kOff && timer.passes_.size() < kMaxPasses) {
  if (!timed_) return;
  index_ = timer_.passes_.size();
  timer_.passes_.push_back({name, 0.0});
  if (timer_.timing_ == Timing::kGpu) {
    if (timer_.queries_[0] == 0)
      glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(timer_.queries_.size()), timer_.queries_.data());
    glQueryCounter(timer_.queries_[2 * index_], GL_TIMESTAMP);
    return;
  }
  glFinish();
  start_ = std::chrono::steady_clock::now();
}

PassTimer::Scope::~Scope() {
  if (!timed_) return;
  if (timer_.timing_ == Timing::kGpu) {
    glQueryCounter(timer_.queries_[2 * index_ + 1], GL_TIMESTAMP);
    return;
  }
  glFinish();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
  timer_.passes_[index_].ms = elapsed.count();
}

}  // namespace jalousie::gl
