// Standard output and error of programs; also where a stream is closed or cannot be written.
#pragma once

#include <string_view>

namespace jalousie {

/// Opens /dev/null in place of closed standard streams, so that no other file gets their numbers. Call it first.
void openStandardStreams();

/// Writes a line to standard error; a failure is ignored.
void printError(std::string_view line) noexcept;

/// Writes all of a text to standard output. Errors: kWriteFailed.
void printOutput(std::string_view text);

}  // namespace jalousie
