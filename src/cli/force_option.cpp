// A flag.
#include "cli/force_option.h"

#include <CLI/CLI.hpp>

namespace jalousie::cli {

void addForceOption(CLI::App& command, Replace& replace) {
  command.add_flag_callback(
      "--force", [&replace] { replace = Replace::kAnything; },
      "Let an output replace a file of another kind; an input is never replaced");
}

}  // namespace jalousie::cli
