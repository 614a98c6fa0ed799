// Receives debug output. It is synchronous and arrives on the calling thread, so the log needs no lock.
#include "gl/debug_log.h"

#include <fmt/format.h>

namespace jalousie::gl {

DebugLog::DebugLog() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&DebugLog::receive, this);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

DebugLog::~DebugLog() {
  glDebugMessageCallback(nullptr, nullptr);
}

void GLAPIENTRY DebugLog::receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                  const GLchar* message, const void* self) {
  if (severity != GL_DEBUG_SEVERITY_MEDIUM && severity != GL_DEBUG_SEVERITY_HIGH) return;
  auto* log = const_cast<DebugLog*>(static_cast<const DebugLog*>(self));
  const std::string text = length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length));
  log->problems_.push_back(fmt::format("source 0x{:x} type 0x{:x} id {}: {}", source, type, id, text));
}

}  // namespace jalousie::gl
