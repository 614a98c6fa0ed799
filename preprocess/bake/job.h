// One bake: files in, one file out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bake/bake_document.h"

namespace jalousie::bake {

struct BakeJob {
  std::vector<std::filesystem::path> inputs;  ///< one, or several PLY and OBJ files that become one document
  std::filesystem::path output;
  std::filesystem::path sheet;  ///< empty: none
};

/// What every job of a run is done with.
struct JobSettings {
  BakeOptions bake;
  bool quantize = false;
  bool compress = false;
  bool makeFolders = false;     ///< make the output's folder if it is not there
  std::filesystem::path cache;  ///< folder; empty: none
  std::string identity;         ///< of program and options; what a cached result depends on besides the inputs
};

enum class JobStatus : std::uint8_t {
  kBaked,
  kCached,     ///< the output comes from the cache
  kUnchanged,  ///< and was there already with the same bytes; only its time is new
  kFailed,
  kNotStarted,  ///< the run was interrupted before
};

/// "baked", "cached", "unchanged", "failed", "not-started".
const char* statusName(JobStatus status);

struct JobResult {
  JobStatus status = JobStatus::kNotStarted;
  std::vector<std::filesystem::path> dependencies;  ///< every file that was read, inputs first
  std::string report;                               ///< as reportJson
  std::string table;                                ///< as reportText
  std::string warning;                              ///< one line; empty if all went well
};

/// Bakes or takes from the cache, and writes sheet and output. Errors: those of importFiles, bakeDocument and
/// writeFileAtomic; the output is intact then.
/// @param progress  what the bake is at, in words
JobResult runJob(const BakeJob& job, const JobSettings& settings,
                 const std::function<void(const std::string&)>& progress);

}  // namespace jalousie::bake
