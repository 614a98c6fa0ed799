// KHR_debug output of the current context, collected.
#pragma once

#include <string>
#include <vector>

#include "gl/handle.h"

namespace jalousie::gl {

/// Collects debug messages while it exists: glDebugMessageCallback, synchronous. Other contexts than debug contexts
/// report little. A second log replaces the first. Not movable, because the driver holds its address.
class DebugLog {
 public:
  DebugLog();
  ~DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  /// Messages of medium or high severity so far; each is a defect.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  static void GLAPIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* self);
  std::vector<std::string> problems_;
};

/// A named group in captures and debug messages, from construction to destruction: glPushDebugGroup, glPopDebugGroup.
class DebugGroup {
 public:
  explicit DebugGroup(const char* name) { glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name); }
  ~DebugGroup() { glPopDebugGroup(); }
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace jalousie::gl
