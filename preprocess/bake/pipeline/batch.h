// Many bakes at once, each in a process of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bake/pipeline/worker.h"

namespace jalousie::bake {

struct BatchOptions {
  unsigned jobs = 0;                            ///< threads in all, over all workers; 0: all cores
  std::optional<std::uint64_t> maxMemoryBytes;  ///< of one worker, 0 for no limit; absent: the machine's, shared fairly
  std::chrono::milliseconds timeout{0};         ///< of one job; 0: none
  bool quiet = false;
  bool lines = false;  ///< a line on standard error for each finished job where no progress can be drawn
};

/// What became of one job: `result.status` says whether `failure` is set.
struct JobOutcome {
  JobResult result;
  std::optional<JobFailure> failure;
};

struct BatchOutcome {
  std::vector<JobOutcome> jobs;  ///< in the order given
  bool interrupted = false;      ///< by SIGINT, SIGTERM or SIGHUP; what was running is not started in `jobs`
};

/// Runs all jobs, failures included. Their lines go to standard error as they happen. To be called from a process with
/// one thread.
BatchOutcome runBatch(std::span<const BakeJob> jobs, const JobSettings& settings, const BatchOptions& options);

}  // namespace jalousie::bake
