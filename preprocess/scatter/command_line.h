// The command line of jalousie-scatter.
#pragma once

#include <optional>

#include "scatter/options.h"

namespace jalousie::scatter {

/// Parses the arguments. After --help it prints the help and returns nullopt.
/// Errors: kUsage with a reason of one line; kWriteFailed where the help cannot be printed
std::optional<Options> parseCommandLine(int argc, const char* const* argv);

}  // namespace jalousie::scatter
