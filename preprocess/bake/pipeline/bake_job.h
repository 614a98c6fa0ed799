// What one bake is given and what it gives back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/io/bake_options.h"
#include "core/error.h"

namespace jalousie::bake {

struct BakeJob {
  std::vector<std::filesystem::path> inputs;  ///< one, or several PLY, OBJ and STL files that become one document
  std::filesystem::path output;
  std::filesystem::path sheet;  ///< empty: none
};

/// Settings that all jobs of a run share.
struct JobSettings {
  BakeOptions bake;
  bool quantize = false;
  bool compress = false;
  bool makeFolders = false;     ///< make the output's folder if it is not there
  bool meshReports = true;      ///< reports describe each mesh; otherwise they have warnings only
  std::filesystem::path cache;  ///< folder; empty: none
  std::string identity;         ///< of program and options; part of the cache key
};

enum class JobStatus : std::uint8_t {
  kBaked,
  kCached,     ///< the output comes from the cache
  kUnchanged,  ///< the output comes from the cache and existed with the same bytes; only its time was set
  kFailed,
  kNotStarted,  ///< the run was interrupted before the job was done
};

/// "baked", "cached", "unchanged", "failed", "not-started".
const char* statusName(JobStatus status);

struct JobResult {
  JobStatus status = JobStatus::kNotStarted;
  std::vector<std::filesystem::path> dependencies;  ///< every file that was read, inputs first
  std::string report;                               ///< as reportJson
  std::string table;                                ///< as reportText
  std::vector<std::string> warnings;                ///< one line each; what was left out, and what went wrong
};

/// Why a job failed.
struct JobFailure {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;  ///< one line that names the file
};

/// A file that was read, or that was sought and does not exist.
struct ReadFile {
  std::size_t input = 0;              ///< index of the input it belongs to
  std::string name;                   ///< relative to that input's folder; empty for the input itself
  std::optional<std::string> sha256;  ///< of its bytes, empty without a cache; absent if there was no such file
};

}  // namespace jalousie::bake
