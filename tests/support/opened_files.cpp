// ptrace: every system call that may open a file stops at its end, where /proc tells which file the descriptor is.
#include "support/opened_files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

namespace jalousie::test {
namespace {

namespace fs = std::filesystem;

constexpr int kTracingForbidden = 126;
char kNoLeakCheck[] = "ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=16";

bool opensFiles(std::uint64_t call) {
#ifdef SYS_open
  if (call == SYS_open || call == SYS_creat) return true;
#endif
  return call == SYS_openat || call == SYS_openat2 || call == SYS_open_by_handle_at;
}

[[noreturn]] void runChild(std::vector<std::string> words) {
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  ::putenv(kNoLeakCheck);
  if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(kTracingForbidden);
  ::raise(SIGSTOP);  // until the parent has set its options
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

/// Follows all threads and processes below a child.
class Tracer {
 public:
  /// @return false where tracing is forbidden
  bool follow(pid_t child) {
    int status = 0;
    if (::waitpid(child, &status, __WALL) != child || !WIFSTOPPED(status)) return false;
    constexpr long kOptions = PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK | PTRACE_O_TRACECLONE |
                              PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL;
    if (::ptrace(PTRACE_SETOPTIONS, child, nullptr, kOptions) != 0) return false;
    ::ptrace(PTRACE_SYSCALL, child, nullptr, 0L);
    for (pid_t stopped = ::waitpid(-1, &status, __WALL); stopped > 0; stopped = ::waitpid(-1, &status, __WALL))
      if (WIFSTOPPED(status)) resume(stopped, status);
    return true;
  }
  std::set<fs::path> opened;

 private:
  void resume(pid_t task, int status) {
    const int signal = WSTOPSIG(status);
    long passedOn = 0;
    if (signal == (SIGTRAP | 0x80)) {
      noteCall(task);
    } else if (status >> 16 == 0 && signal != SIGSTOP) {  // no event of ptrace and no start of a new task
      passedOn = signal;
    }
    ::ptrace(PTRACE_SYSCALL, task, nullptr, passedOn);
  }

  void noteCall(pid_t task) {
    __ptrace_syscall_info info = {};
    if (::ptrace(PTRACE_GET_SYSCALL_INFO, task, sizeof info, &info) <= 0) return;
    if (info.op == PTRACE_SYSCALL_INFO_ENTRY) opening_[task] = opensFiles(info.entry.nr);
    if (info.op != PTRACE_SYSCALL_INFO_EXIT || !opening_[task] || info.exit.is_error != 0) return;
    std::error_code gone;
    const fs::path link = "/proc/" + std::to_string(task) + "/fd/" + std::to_string(info.exit.rval);
    const fs::path file = fs::read_symlink(link, gone);
    if (!gone) opened.insert(file);
  }

  std::map<pid_t, bool> opening_;  ///< per task whether the call that it is in may open a file
};

}  // namespace

std::optional<std::set<fs::path>> filesOpenedBy(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) runChild(std::move(words));
  Tracer tracer;
  if (!tracer.follow(child)) return std::nullopt;
  return std::move(tracer.opened);
}

}  // namespace jalousie::test
