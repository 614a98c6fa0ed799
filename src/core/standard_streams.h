// Standard output and error of programs; also where a stream is closed or cannot be written.
#pragma once

#include <string_view>

namespace jalousie {

/// Opens /dev/null in place of closed standard streams, so that no other file gets their numbers. Reading from or
/// writing to a stream that was closed still fails. Call it first.
void openStandardStreams();

/// Writes a line to standard error; a failure is ignored.
void printError(std::string_view line) noexcept;

/// Writes all of a text to standard output. Errors: kWriteFailed.
void printOutput(std::string_view text);

/// Writes what the C and C++ libraries still hold for standard output. Errors: kWriteFailed, also for a write that
/// failed earlier and that nobody noticed.
void flushOutput();

/// Whether standard output is a pipe that nobody reads any more, as a failed write has shown.
bool outputReaderIsGone() noexcept;

}  // namespace jalousie
