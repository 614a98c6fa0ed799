// Standard output and error of programs that must not fall over when nobody listens.
#pragma once

#include <string_view>

namespace jalousie {

/// Opens /dev/null in the place of standard streams that are closed, so that no other file gets their numbers. To be
/// called first of all.
void openStandardStreams();

/// Writes a line to standard error; if that fails, nobody can be told.
void printError(std::string_view line) noexcept;

/// Writes text to standard output, all of it. Errors: kWriteFailed.
void printOutput(std::string_view text);

}  // namespace jalousie
