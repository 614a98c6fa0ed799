// `jalousie compare`: one camera path under several configurations, and a report.
#pragma once

#include "app/compare_options.h"

namespace jalousie::app {

/// Exit code after Ctrl-C or SIGTERM: what was measured is in the report, --resume goes on.
inline constexpr int kInterrupted = 130;

/// Loads, measures, writes. @param options  finished   @return 0 or kInterrupted
/// Errors: as the loaders, kUsage, kNoGpu, kShader, kWriteFailed.
int runCompare(const CompareOptions& options);

}  // namespace jalousie::app
