// Runs one bake: input files to one output file.
#pragma once

#include <functional>
#include <string>

#include "bake/pipeline/bake_job.h"

namespace jalousie::bake {

/// Bakes or takes from the cache, and writes sheet and output. Errors: those of importFiles, bakeDocument and
/// writeFileAtomic; the output is intact then.
/// @param progress  called with a description of the current step
JobResult runJob(const BakeJob& job, const JobSettings& settings,
                 const std::function<void(const std::string&)>& progress);

}  // namespace jalousie::bake
