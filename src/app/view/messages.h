// Messages to the user, and the failures that become the exit code of a script.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/view/redraw.h"
#include "app/view/view_state.h"
#include "core/error.h"

namespace jalousie::app {

/// Shows the last message in the window for a few seconds and collects failures of what was asked for.
class Messages {
 public:
  /// @param state  gets the message; both must outlive this
  Messages(ViewState& state, Redraw& redraw) : state_(state), redraw_(redraw) {}

  void say(const std::string& message);
  /// Shows a failure and records it.
  void fail(const Error& error);
  /// Runs a task and shows its exception as a message; the viewer continues.
  void attempt(const std::function<void()>& task);
  /// Recorded by fail(), oldest first.
  const std::vector<Error>& failures() const { return failures_; }

 private:
  ViewState& state_;
  Redraw& redraw_;
  std::vector<Error> failures_;
};

}  // namespace jalousie::app
