// OpenGL debug output of a subcommand: the option that asks for it, and the error that it becomes.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>

#include "core/error.h"
#include "gl/debug_log.h"

namespace jalousie::app {

/// Adds --debug, which the environment variable JALOUSIE_GL_DEBUG=1 sets as well.
inline void addDebugOption(CLI::App& command, bool& debug) {
  command
      .add_flag("--debug", debug, "Make an OpenGL debug context; exit code 70 on a message of medium or high severity")
      ->envname("JALOUSIE_GL_DEBUG");
}

/// Collects the debug messages of the current context while it lives. Make it after the context.
class GlDebug {
 public:
  /// @param enabled  false: collects nothing, costs nothing
  explicit GlDebug(bool enabled) {
    if (enabled) log_.emplace();
  }

  /// Waits for the GPU. Errors: kInternal if there was a message of medium or high severity.
  void check() const {
    if (!log_) return;
    glFinish();
    if (log_->problems().empty()) return;
    throw Error(ErrorCode::kInternal,
                fmt::format("OpenGL reported {} messages of medium or high severity, the first: {}",
                            log_->problems().size(), log_->problems().front()));
  }

 private:
  std::optional<gl::DebugLog> log_;
};

}  // namespace jalousie::app
