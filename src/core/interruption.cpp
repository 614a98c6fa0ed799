// The handler calls only functions that are safe in signal handlers.
#include "core/interruption.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

namespace jalousie {
namespace {

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM};
constexpr int kCodeOfSignals = 128;
constexpr std::string_view kEraseLine = "\r\033[K";

std::atomic<bool> deferred = false;
std::atomic<int> arrived = 0;  ///< number of the deferred signal; 0: none
std::atomic<int> held = 0;     ///< number of HeldInterruptions
std::atomic<int> waiting = 0;  ///< number of a signal that came while they lived; 0: none
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

char line[128];
std::size_t lineBytes = 0;

void act(int signal) {
  int none = 0;
  if (deferred && arrived.compare_exchange_strong(none, signal)) return;
  // A failure to print changes nothing: the program ends.
  static_cast<void>(!::write(STDERR_FILENO, line, lineBytes));
  ::_exit(kCodeOfSignals + signal);
}

void actOnWaiting() {
  if (const int signal = waiting.exchange(0); signal != 0) act(signal);
}

void handle(int signal) {
  if (held == 0) return act(signal);
  waiting = signal;
  if (held == 0) actOnWaiting();  // the last holder may have gone in between
}

bool isIgnored(int signal) {
  struct sigaction action = {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void endOnInterruptions(const char* name) {
  const std::string_view erase = ::isatty(STDERR_FILENO) == 1 ? kEraseLine : "";  // of core/progress.h
  const auto end = fmt::format_to_n(line, sizeof line, "{}{:.80}: interrupted\n", erase, name);
  lineBytes = end.size < sizeof line ? end.size : sizeof line;
  struct sigaction action = {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  for (const int signal : kSignals)
    if (!isIgnored(signal)) ::sigaction(signal, &action, nullptr);
}

void ignoreInterruptions() {
  for (const int signal : kSignals)
    ::signal(signal, SIG_IGN);
}

DeferredInterruptions::DeferredInterruptions() {
  deferred = true;
}

DeferredInterruptions::~DeferredInterruptions() {
  deferred = false;
}

bool interrupted() noexcept {
  return arrived != 0;
}

int interruptionExitCode() noexcept {
  return kCodeOfSignals + arrived;
}

HeldInterruptions::HeldInterruptions() {
  ++held;  // for signals that other threads receive; the mask holds even without a handler
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : kSignals)
    ::sigaddset(&signals, signal);
  ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

HeldInterruptions::~HeldInterruptions() {
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  if (--held == 0) actOnWaiting();
}

}  // namespace jalousie
