// Runs many bakes in parallel, each in a process of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bake/pipeline/worker.h"

namespace jalousie::bake {

struct BatchOptions {
  unsigned jobs = 0;                                 ///< threads in all, over all workers; 0: all cores
  std::optional<std::uint64_t> maxMemoryBytes;       ///< of one worker, 0 for no limit; absent: defaultMemory
  std::optional<std::chrono::milliseconds> timeout;  ///< of one job, 0 for no limit; absent: defaultTimeout
  bool quiet = false;
  bool lines = false;  ///< print a line on standard error for each finished job if no progress can be drawn
};

/// The time that a job may take if the options name none: far more than any honest file of this size needs.
/// @param inputBytes  of all inputs of the job together
std::chrono::milliseconds defaultTimeout(std::uint64_t inputBytes);
/// The memory that a job may take if the options name no limit, bytes. @param share  of the machine's for one worker
std::uint64_t defaultMemory(std::uint64_t inputBytes, std::uint64_t share);

/// The outcome of one job. `failure` is set if `result.status` is kFailed.
struct JobOutcome {
  JobResult result;
  std::optional<JobFailure> failure;
};

struct BatchOutcome {
  std::vector<JobOutcome> jobs;  ///< in the order given
  bool interrupted = false;      ///< by SIGINT, SIGTERM or SIGHUP; jobs that were running then count as not started
};

/// Runs all jobs; a failure does not stop the others. Messages go to standard error as they arrive.
/// @pre the process has one thread
BatchOutcome runBatch(std::span<const BakeJob> jobs, const JobSettings& settings, const BatchOptions& options);

}  // namespace jalousie::bake
