// `jalousie compare`: measures several configurations along one camera path and writes a report.
#pragma once

#include "app/compare_options.h"

namespace jalousie::app {

/// A signal ends the measurements after the current step. The report then holds what was measured; --resume continues
/// it. @param options  after finish()   @return  exit code, 0 or that of core/interruption.h
/// Errors: kUsage, kNoGpu, kShader, kWriteFailed (another run is using the folder, too), as readSceneFile.
int runCompare(const CompareOptions& options);

}  // namespace jalousie::app
