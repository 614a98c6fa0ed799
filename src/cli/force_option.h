// The option that lets an output replace a file of another kind.
#pragma once

#include "core/output_files.h"

namespace CLI {
class App;
}

namespace jalousie::cli {

/// Declares --force on a command; replace must outlive the parse.
void addForceOption(CLI::App& command, Replace& replace,
                    const char* help = "Let an output replace a file of another kind; an input is never replaced");

}  // namespace jalousie::cli
