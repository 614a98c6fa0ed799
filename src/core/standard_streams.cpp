// fmt::print throws where a stream cannot be written, which is no help in an error handler.
#include "core/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>

#include "core/error.h"

namespace jalousie {
namespace {

bool readerIsGone = false;

[[noreturn]] void failOutput(int reason) {
  readerIsGone = reason == EPIPE;
  const char* text = reason == EBADF ? "is closed" : reason != 0 ? std::strerror(reason) : "cannot be written";
  throw Error(ErrorCode::kWriteFailed, text, "standard output");
}

}  // namespace

void openStandardStreams() {
  for (int file = 0; file <= 2; ++file) {
    // Opened the wrong way round, so that a use is an error. open takes the lowest free number.
    const int flags = file == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (::fcntl(file, F_GETFD) < 0) static_cast<void>(::open("/dev/null", flags));
  }
}

void printError(std::string_view line) noexcept {
  try {
    const std::string text = std::string(line) + '\n';  // one write, so that lines of several processes do not mix
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  } catch (const std::exception&) {
    return;  // no memory for the line
  }
}

void printOutput(std::string_view text) {
  flushOutput();
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) failOutput(written < 0 ? errno : ENOSPC);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void flushOutput() {
  std::cout.flush();
  errno = 0;
  const bool hadFailed = std::ferror(stdout) != 0;
  if (std::fflush(stdout) != 0) failOutput(errno);
  if (hadFailed) failOutput(0);
}

bool outputReaderIsGone() noexcept {
  return readerIsGone;
}

}  // namespace jalousie
