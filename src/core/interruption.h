// SIGHUP, SIGINT and SIGTERM: how they end a program, and how work that has results to save waits for them.
#pragma once

#include <signal.h>

namespace jalousie {

/// From now on SIGHUP, SIGINT and SIGTERM end the program at once, with all its threads: one line on standard error,
/// exit code 128 + number of the signal. Signals that are ignored at the call stay ignored, as nohup needs it.
/// @param name  of the program, for the line; at most 80 bytes of it are shown
void endOnInterruptions(const char* name);

/// Ignores the three signals: for a child process that its parent ends.
void ignoreInterruptions();

/// While it lives, the first of the three signals only sets interrupted(); the second one ends the program at once.
/// One at a time. @pre endOnInterruptions was called; otherwise the signals keep their effect.
class DeferredInterruptions {
 public:
  DeferredInterruptions();
  ~DeferredInterruptions();
  DeferredInterruptions(const DeferredInterruptions&) = delete;
  DeferredInterruptions& operator=(const DeferredInterruptions&) = delete;
};

/// Whether a signal arrived while DeferredInterruptions lived.
bool interrupted() noexcept;
/// 128 + number of the signal that arrived. @pre interrupted()
int interruptionExitCode() noexcept;

/// While it lives, the three signals wait: for moments in which a file has a temporary name.
class HeldInterruptions {
 public:
  HeldInterruptions();
  ~HeldInterruptions();
  HeldInterruptions(const HeldInterruptions&) = delete;
  HeldInterruptions& operator=(const HeldInterruptions&) = delete;

 private:
  sigset_t before_ = {};
};

}  // namespace jalousie
