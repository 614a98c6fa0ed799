// The jobs of a batch: one for each input file.
#pragma once

#include <filesystem>
#include <vector>

#include "bake/io/inputs.h"
#include "bake/pipeline/bake_job.h"

namespace jalousie::bake {

/// A job for each input, its output at the same place below `folder` as .glb, its sheet below `sheets` as .html if that
/// is not empty. @param keepExtension  chair.obj becomes chair.obj.glb. Errors: kUsage (two inputs with one output, an
/// output that is an input).
std::vector<BakeJob> jobsInto(const std::filesystem::path& folder, const std::filesystem::path& sheets,
                              const std::vector<InputFile>& inputs, bool keepExtension);

}  // namespace jalousie::bake
