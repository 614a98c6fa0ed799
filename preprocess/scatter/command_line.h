// The command line of jalousie-scatter.
#pragma once

#include <optional>

#include "scatter/options.h"

namespace jalousie::scatter {

/// Parses the arguments; prints the help and returns nullopt where that is asked for.
/// Errors: kUsage with one line of reason.
std::optional<Options> parseCommandLine(int argc, const char* const* argv);

}  // namespace jalousie::scatter
