// One loop: starts workers, waits for their messages or a signal, and collects results.
#include "bake/pipeline/batch.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <list>
#include <set>
#include <string>
#include <thread>

#include "bake/pipeline/progress_log.h"
#include "core/file.h"
#include "core/interruption.h"
#include "core/progress.h"

namespace jalousie::bake {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr unsigned kMaxJobs = 256;

std::uint64_t bytesOf(const fs::path& file) {
  std::error_code absent;
  const std::uintmax_t size = fs::file_size(file, absent);
  return absent ? 0 : size;
}

/// Bytes of a job's inputs. A .gltf file counts with the .bin files beside it: one of them is likely its buffer.
std::uint64_t bytesOf(const BakeJob& job) {
  std::uint64_t bytes = 0;
  for (const fs::path& input : job.inputs) {
    bytes += bytesOf(input);
    if (input.extension() != ".gltf") continue;
    std::error_code failed;
    for (fs::directory_iterator file(folderOf(input), failed), end; !failed && file != end; file.increment(failed))
      if (file->path().extension() == ".bin") bytes += bytesOf(file->path());
  }
  return std::max<std::uint64_t>(bytes, 1);
}

/// The memory limit of the control group; the largest number if there is none.
std::uint64_t controlGroupMemory() {
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::uint64_t bytes = 0;
    if (std::ifstream(file) >> bytes && bytes > 0) return bytes;
  }
  return std::numeric_limits<std::uint64_t>::max();
}

struct Running {
  std::size_t job;
  Worker worker;
  Clock::time_point start;
  std::chrono::milliseconds timeout;  ///< 0: none
};

class Batch {
 public:
  Batch(std::span<const BakeJob> jobs, const JobSettings& settings, const BatchOptions& options)
      : jobs_(jobs),
        settings_(settings),
        options_(options),
        progress_("baking", jobs.size() == 1 ? 0 : totalBytes(jobs), options.quiet) {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    const unsigned threads = std::clamp(options.jobs == 0 ? cores : options.jobs, 1U, kMaxJobs);
    workers_ = std::min<std::size_t>(threads, jobs.size());
    limits_.threads = std::max(1U, threads / static_cast<unsigned>(std::max<std::size_t>(workers_, 1)));
    outcome_.jobs.resize(jobs.size());
  }

  BatchOutcome run() {
    ::signal(SIGCHLD, SIG_DFL);  // if it were ignored, the exit codes of workers would be lost
    for (const fs::path& folder : outputFolders())
      removeAbandonedFiles(folder);
    while ((next_ < jobs_.size() || !running_.empty()) && !outcome_.interrupted) {
      startWorkers();
      wait();
    }
    running_.clear();  // kills workers that still run after an interruption
    if (outcome_.interrupted)
      for (const fs::path& folder : outputFolders())
        removeAbandonedFiles(folder);
    return std::move(outcome_);
  }

 private:
  static std::uint64_t totalBytes(std::span<const BakeJob> jobs) {
    std::uint64_t bytes = 0;
    for (const BakeJob& job : jobs)
      bytes += bytesOf(job);
    return bytes;
  }

  std::uint64_t memoryShare() const {
    const auto pages = static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES)));
    const auto page = static_cast<std::uint64_t>(std::max(0L, ::sysconf(_SC_PAGESIZE)));
    return std::min(pages * page, controlGroupMemory()) / 10 * 9 / std::max<std::size_t>(workers_, 1);
  }

  std::set<fs::path> outputFolders() const {
    std::set<fs::path> folders;
    for (const BakeJob& job : jobs_)
      for (const fs::path& file : {job.output, job.sheet})
        if (!file.empty()) folders.insert(folderOf(file));
    return folders;
  }

  void startWorkers() {
    while (running_.size() < workers_ && next_ < jobs_.size()) {
      try {
        const std::uint64_t bytes = bytesOf(jobs_[next_]);
        WorkerLimits limits = limits_;
        limits.maxMemoryBytes =
            options_.maxMemoryBytes ? *options_.maxMemoryBytes : defaultMemory(bytes, memoryShare());
        const std::chrono::milliseconds timeout = options_.timeout ? *options_.timeout : defaultTimeout(bytes);
        running_.emplace_back(Running{next_, Worker(jobs_[next_], settings_, limits), Clock::now(), timeout});
      } catch (const Error&) {
        if (running_.empty()) throw;
        return;  // out of processes or pipes; try again when a running worker has ended
      }
      ++next_;
    }
  }

  void wait() {
    std::vector<pollfd> files;
    for (const Running& running : running_)
      files.push_back({running.worker.descriptor(), POLLIN, 0});
    const bool heard = ::poll(files.data(), files.size(), 200) > 0;  // a signal ends the call as well
    outcome_.interrupted = interrupted();
    if (outcome_.interrupted) return;
    std::size_t file = 0;
    for (auto running = running_.begin(); running != running_.end(); ++file) {
      if (heard && files[file].revents != 0 && !running->worker.listen()) {
        finish(*running);
        running = running_.erase(running);
        continue;
      }
      if (running->timeout.count() > 0 && Clock::now() - running->start > running->timeout)
        running->worker.kill(fmt::format("took longer than the {:g} s of --timeout",
                                         static_cast<double>(running->timeout.count()) / 1000.0));
      ++running;
    }
    showProgress();
  }

  void finish(Running& running) {
    JobOutcome& outcome = outcome_.jobs[running.job];
    std::optional<JobResult> result;
    running.worker.finish(result, outcome.failure);
    if (result) outcome.result = std::move(*result);
    if (outcome.failure) outcome.result.status = JobStatus::kFailed;
    ++finished_;
    finishedBytes_ += bytesOf(jobs_[running.job]);
    announce(jobs_[running.job], outcome, std::chrono::duration<double>(Clock::now() - running.start).count());
  }

  void announce(const BakeJob& job, const JobOutcome& outcome, double seconds) {
    if (outcome.failure) progress_.print(fmt::format("jalousie-bake: {}", outcome.failure->message));
    for (const std::string& warning : outcome.result.warnings)
      progress_.print(
          fmt::format("jalousie-bake: warning: {}: {}", oneLine(job.inputs.front().string()), oneLine(warning)));
    if (!options_.lines || options_.quiet || progress_.visible()) return;
    progress_.print(fmt::format("[{}/{}] {} {} -> {} ({:.1f} s)", finished_, jobs_.size(),
                                statusName(outcome.result.status), oneLine(job.inputs.front().string()),
                                oneLine(job.output.string()), seconds));
  }

  void showProgress() {
    if (jobs_.size() == 1) return showSteps(running_.empty() ? "" : running_.front().worker.progress());
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string text = fmt::format("{} of {} files", finished_, jobs_.size());
    if (finished_ > 0) {
      const double left = elapsed * static_cast<double>(totalBytes_ - std::min(totalBytes_, finishedBytes_)) /
                          static_cast<double>(finishedBytes_);
      text += fmt::format(", {:.3g} files/s, {} left", static_cast<double>(finished_) / elapsed, durationText(left));
    }
    if (!running_.empty()) text += ": " + jobs_[running_.front().job].inputs.front().filename().string();
    progress_.update(finishedBytes_, text);
  }

  /// A terminal shows each step of a single file, a log a line from time to time.
  void showSteps(const std::string& step) {
    progress_.update(0, step);
    if (progress_.visible() || options_.quiet || running_.empty()) return;
    if (const auto line = log_.lineAt(Clock::now(), oneLine(step)))
      progress_.print(fmt::format("jalousie-bake: {}", *line));
  }

  std::span<const BakeJob> jobs_;
  const JobSettings& settings_;
  const BatchOptions& options_;
  DeferredInterruptions deferred_;
  Progress progress_;
  WorkerLimits limits_;
  std::size_t workers_ = 1;
  std::size_t next_ = 0;
  std::size_t finished_ = 0;
  std::uint64_t totalBytes_ = totalBytes(jobs_);
  std::uint64_t finishedBytes_ = 0;
  Clock::time_point start_ = Clock::now();
  ProgressLog log_{start_};
  std::list<Running> running_;
  BatchOutcome outcome_;
};

}  // namespace

std::chrono::milliseconds defaultTimeout(std::uint64_t inputBytes) {
  constexpr std::uint64_t kFree = 600;      // seconds
  constexpr std::uint64_t kPerMiB = 60;     // seconds
  constexpr std::uint64_t kMost = 500'000;  // seconds
  return std::chrono::seconds(std::min(kFree + kPerMiB * (inputBytes >> 20U), kMost));
}

std::uint64_t defaultMemory(std::uint64_t inputBytes, std::uint64_t share) {
  constexpr std::uint64_t kFree = 4ULL << 30U;
  constexpr std::uint64_t kPerByte = 64;
  return std::min(share, kFree + kPerByte * std::min(inputBytes, share));
}

BatchOutcome runBatch(std::span<const BakeJob> jobs, const JobSettings& settings, const BatchOptions& options) {
  return Batch(jobs, settings, options).run();
}

}  // namespace jalousie::bake
