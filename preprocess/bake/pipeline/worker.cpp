// Messages from child to parent: a length, a letter and length-prefixed texts. P: progress, R: result, E: error.
#include "bake/pipeline/worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include "bake/pipeline/job.h"
#include "bake/pipeline/threads.h"
#include "core/interruption.h"

namespace jalousie::bake {
namespace {

using Fields = std::vector<std::string>;

void appendNumber(std::string& text, std::size_t value) {
  const std::uint64_t number = value;
  text.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::uint64_t numberAt(const std::string& text, std::size_t at) {
  std::uint64_t number = 0;
  if (at + sizeof number <= text.size()) std::memcpy(&number, text.data() + at, sizeof number);
  return number;
}

void send(int pipe, char kind, const Fields& fields) {
  std::string content(1, kind);
  for (const std::string& field : fields) {
    appendNumber(content, field.size());
    content += field;
  }
  std::string message;
  appendNumber(message, content.size());
  message += content;
  std::size_t sent = 0;
  while (sent < message.size()) {
    const ssize_t written = ::write(pipe, message.data() + sent, message.size() - sent);
    if (written < 0 && errno != EINTR) return;  // the parent has ended
    if (written > 0) sent += static_cast<std::size_t>(written);
  }
}

/// Takes a complete message from the front of `received`; false if there is none yet.
bool takeMessage(std::string& received, char& kind, Fields& fields) {
  constexpr std::size_t kNumber = sizeof(std::uint64_t);
  if (received.size() < kNumber + 1 || received.size() - kNumber < numberAt(received, 0)) return false;
  const std::size_t end = kNumber + static_cast<std::size_t>(numberAt(received, 0));
  kind = received[kNumber];
  fields.clear();
  for (std::size_t at = kNumber + 1; at + kNumber <= end;) {
    const auto length = static_cast<std::size_t>(numberAt(received, at));
    fields.push_back(received.substr(at + kNumber, length));
    at += kNumber + length;
  }
  received.erase(0, end);
  return true;
}

void limitMemory(std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__)  // its shadow memory alone takes terabytes of address space
  if (bytes == 0) return;
  const rlimit limit = {bytes, bytes};
  ::setrlimit(RLIMIT_DATA, &limit);
#else
  static_cast<void>(bytes);
#endif
}

/// Documents are parsed and freed several times. Asking the kernel for the same pages each time cost a fifth of the CPU
/// time of files with thousands of meshes. Merging small freed blocks, which large requests trigger, cost a twelfth.
void keepFreedMemory() {
#if defined(__GLIBC__)
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
  ::mallopt(M_TOP_PAD, 16 << 20);
  ::mallopt(M_MXFAST, 0);
#endif
}

[[noreturn]] void fail(int pipe, ErrorCode code, const std::string& message) {
  send(pipe, 'E', {fmt::format("{}", static_cast<int>(code)), oneLine(message)});
  std::exit(static_cast<int>(code));
}

/// Runs the job in the child. Exits normally, so that sanitizers and coverage write their results.
[[noreturn]] void work(int pipe, const BakeJob& job, const JobSettings& settings, const WorkerLimits& limits) {
  const std::string input = job.inputs.front().string();
  try {
    limitMemory(limits.maxMemoryBytes);
    keepFreedMemory();
    JobSettings threaded = settings;
    threaded.bake.chain.slices = threadedSlices(limits.threads);
    threaded.bake.tasks = threadedTasks(limits.threads);
    auto nextReport = std::chrono::steady_clock::time_point();
    const JobResult result = runJob(job, threaded, [&](const std::string& what) {
      const auto now = std::chrono::steady_clock::now();
      if (now < nextReport) return;
      nextReport = now + std::chrono::milliseconds(100);
      send(pipe, 'P', {what.substr(0, 500)});
    });
    Fields fields = {fmt::format("{}", static_cast<int>(result.status)), result.report, result.table,
                     fmt::format("{}", fmt::join(result.warnings, "\n"))};
    for (const std::filesystem::path& file : result.dependencies)
      fields.push_back(file.string());
    send(pipe, 'R', fields);
    std::exit(0);
  } catch (const Error& error) {
    // Errors about the content carry no path of their own.
    fail(pipe, error.code(), error.file().empty() ? fmt::format("{}: {}", input, error.what()) : error.what());
  } catch (const std::bad_alloc&) {
    fail(pipe, ErrorCode::kLimit,
         limits.maxMemoryBytes == 0 ? fmt::format("{}: out of memory", input)
                                    : fmt::format("{}: needs more memory than the {} MiB of --max-memory", input,
                                                  limits.maxMemoryBytes >> 20U));
  } catch (const std::exception& error) {
    fail(pipe, ErrorCode::kInternal, fmt::format("{}: {}", input, error.what()));
  }
}

}  // namespace

Worker::Worker(const BakeJob& job, const JobSettings& settings, const WorkerLimits& limits)
    : firstInput_(oneLine(job.inputs.front().string())) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(ErrorCode::kInternal, std::strerror(errno));
  pipe_ = Descriptor(ends[0]);
  Descriptor childEnd(ends[1]);
  std::fflush(nullptr);  // otherwise both processes would write the buffered output
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) throw Error(ErrorCode::kInternal, fmt::format("no process for a bake: {}", std::strerror(errno)));
  if (pid_ > 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) std::_Exit(0);
  ignoreInterruptions();  // a terminal signals all processes of a command; the parent ends this one
  work(childEnd.get(), job, settings, limits);
}

Worker::Worker(Worker&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pipe_(std::move(other.pipe_)),
      firstInput_(std::move(other.firstInput_)),
      received_(std::move(other.received_)),
      progress_(std::move(other.progress_)),
      killReason_(std::move(other.killReason_)),
      result_(std::move(other.result_)),
      failure_(std::move(other.failure_)) {}

Worker::~Worker() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

bool Worker::listen() {
  static char buffer[1 << 20];
  const ssize_t got = ::read(pipe_.get(), buffer, sizeof buffer);
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  received_.append(buffer, static_cast<std::size_t>(got));
  char kind = 0;
  std::vector<std::string> fields;
  while (takeMessage(received_, kind, fields))
    take(kind, fields);
  return got > 0;
}

void Worker::take(char kind, const std::vector<std::string>& fields) {
  if (kind == 'P') progress_ = fields.at(0);
  if (kind == 'E') failure_ = JobFailure{static_cast<ErrorCode>(std::stoi(fields.at(0))), fields.at(1)};
  if (kind != 'R') return;
  JobResult result;
  result.status = static_cast<JobStatus>(std::stoi(fields.at(0)));
  result.report = fields.at(1);
  result.table = fields.at(2);
  std::istringstream warnings(fields.at(3));
  for (std::string line; std::getline(warnings, line);)
    result.warnings.push_back(line);
  for (std::size_t i = 4; i < fields.size(); ++i)
    result.dependencies.emplace_back(fields[i]);
  result_ = std::move(result);
}

void Worker::finish(std::optional<JobResult>& result, std::optional<JobFailure>& failure) {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  result = std::move(result_);
  failure = std::move(failure_);
  const bool ended = WIFEXITED(status);
  if (ended && WEXITSTATUS(status) == 0 && result) return;
  result.reset();
  if (ended && failure && WEXITSTATUS(status) == static_cast<int>(failure->code)) return;
  failure = JobFailure();
  if (!killReason_.empty()) {
    failure = {ErrorCode::kLimit, fmt::format("{}: {}", firstInput_, killReason_)};
  } else if (!ended && WTERMSIG(status) == SIGKILL) {
    failure = {
        ErrorCode::kLimit,
        fmt::format("{}: the bake was killed, most likely because memory ran out; see --max-memory", firstInput_)};
  } else {
    const std::string how = ended ? fmt::format("ended with code {}", WEXITSTATUS(status))
                                  : fmt::format("crashed with signal {}", WTERMSIG(status));
    failure->message =
        fmt::format("{}: the bake {}; this is a defect, please report it with the file", firstInput_, how);
  }
}

void Worker::kill(const std::string& reason) {
  killReason_ = reason;
  ::kill(pid_, SIGKILL);
}

}  // namespace jalousie::bake
