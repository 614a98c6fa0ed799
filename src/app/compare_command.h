// `jalousie compare`: measures several configurations along one camera path and writes a report.
#pragma once

#include "app/compare_options.h"

namespace jalousie::app {

/// Exit code after SIGINT or SIGTERM. The report holds what was measured; --resume continues it.
inline constexpr int kInterrupted = 130;

/// @param options  after finish()   @return  exit code, 0 or kInterrupted
/// Errors: kUsage, kNoGpu, kShader, kWriteFailed, as readSceneFile.
int runCompare(const CompareOptions& options);

}  // namespace jalousie::app
