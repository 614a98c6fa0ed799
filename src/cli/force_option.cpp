// A flag.
#include "cli/force_option.h"

#include <CLI/CLI.hpp>

namespace jalousie::cli {

void addForceOption(CLI::App& command, Replace& replace, const char* help) {
  command.add_flag_callback(
      "--force", [&replace] { replace = Replace::kAnything; }, help);
}

}  // namespace jalousie::cli
