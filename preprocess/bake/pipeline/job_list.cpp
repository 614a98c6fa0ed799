// Derives the outputs from the inputs and refuses outputs that collide.
#include "bake/pipeline/job_list.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "core/error.h"

namespace jalousie::bake {

namespace fs = std::filesystem;

std::vector<BakeJob> jobsInto(const fs::path& folder, const fs::path& sheets, const std::vector<InputFile>& inputs,
                              bool keepExtension) {
  std::set<fs::path> inputPaths;
  for (const InputFile& input : inputs)
    inputPaths.insert(canonicalPath(input.path));
  std::map<fs::path, fs::path> taken;
  std::vector<BakeJob> jobs;
  for (const InputFile& input : inputs) {
    fs::path relative = input.relative;
    if (!keepExtension) relative.replace_extension();
    BakeJob job;
    job.inputs = {input.path};
    job.output = folder / (relative.string() + ".glb");
    if (!sheets.empty()) job.sheet = sheets / (relative.string() + ".html");
    const auto [other, isNew] = taken.emplace(canonicalPath(job.output), input.path);
    if (!isNew)
      throw Error(ErrorCode::kUsage, fmt::format("{} and {} would both become {}; see --keep-extension",
                                                 other->second.string(), input.path.string(), job.output.string()));
    if (inputPaths.contains(canonicalPath(job.output)))
      throw Error(ErrorCode::kUsage,
                  fmt::format("{} would be overwritten by a result; choose another folder", job.output.string()));
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace jalousie::bake
