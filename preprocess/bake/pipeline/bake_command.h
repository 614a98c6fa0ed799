// Runs jalousie-bake, from options to exit code.
#pragma once

#include "bake/pipeline/command_line.h"

namespace jalousie::bake {

/// Bakes one file or a batch and writes reports, sheets and depfile. Failures of single files are printed.
/// @return  the exit code: 0; of the file that failed, or kSomeFailed for a batch; after a signal that of
/// core/interruption.h. Errors: those that concern the whole run: kUsage, kFileNotFound (a folder or pattern without
/// files), kWriteFailed (report, depfile).
int runBake(const CommandLine& command);

}  // namespace jalousie::bake
