// A bake in a process of its own: a crash or a memory limit ends only this bake.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "bake/pipeline/bake_job.h"
#include "core/descriptor.h"

namespace jalousie::bake {

struct WorkerLimits {
  std::uint64_t maxMemoryBytes = 0;  ///< of heap and stacks; 0: no limit. Not enforced in sanitizer builds
  unsigned threads = 1;
};

class Worker {
 public:
  /// Forks and starts the job. @pre the process has one thread. Errors: kInternal (the process cannot be made).
  Worker(const BakeJob& job, const JobSettings& settings, const WorkerLimits& limits);
  /// Kills the process if it still runs.
  ~Worker();
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&&) = delete;

  /// Readable when the worker has sent a message or has ended.
  int descriptor() const { return pipe_.get(); }
  /// Reads the messages that have arrived. @return  false once the worker has ended and finish may be called
  bool listen();
  /// Description of the current step.
  const std::string& progress() const { return progress_; }
  /// Waits for the process. Sets exactly one of the two.
  void finish(std::optional<JobResult>& result, std::optional<JobFailure>& failure);
  /// Ends the worker; finish then reports a failure with this reason.
  void kill(const std::string& reason);

 private:
  void take(char kind, const std::vector<std::string>& fields);

  pid_t pid_ = -1;
  Descriptor pipe_;
  std::string firstInput_;
  std::string received_;
  std::string progress_;
  std::string killReason_;
  std::optional<JobResult> result_;
  std::optional<JobFailure> failure_;
};

}  // namespace jalousie::bake
