// fork and exec with both outputs redirected to files.
#include "support/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace jalousie::test {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void redirect(int target, const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || ::dup2(fd, target) < 0) ::_exit(127);
  if (fd != target) ::close(fd);
}

/// Makes jalousie use an OpenGL debug context and exit with code 70 on a message. Other programs ignore it.
char kDebugVariable[] = "JALOUSIE_GL_DEBUG=1";

void connectOutput(StandardOutput output, const std::filesystem::path& file) {
  switch (output) {
    case StandardOutput::kCollected:
      return redirect(STDOUT_FILENO, file);
    case StandardOutput::kFull:
      return redirect(STDOUT_FILENO, "/dev/full");
    case StandardOutput::kClosed:
      ::close(STDOUT_FILENO);
      return;
    case StandardOutput::kNoReader:
      break;
  }
  int ends[2] = {-1, -1};
  if (::pipe(ends) != 0 || ::close(ends[0]) != 0 || ::dup2(ends[1], STDOUT_FILENO) < 0) ::_exit(127);
  ::close(ends[1]);
}

}  // namespace

RunningProgram::RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                               const ProgramSetup& setup)
    : folder_(std::make_unique<TemporaryFolder>()) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  // Set before the fork, or a signal could come first.
  const auto before = setup.ignoredSignal != 0 ? ::signal(setup.ignoredSignal, SIG_IGN) : SIG_DFL;
  pid_ = ::fork();
  if (pid_ != 0 && setup.ignoredSignal != 0) ::signal(setup.ignoredSignal, before);
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ > 0) return;
  redirect(STDERR_FILENO, *folder_ / "err");
  connectOutput(setup.output, *folder_ / "out");  // last, since a closed stream's number would be taken
  if (!setup.folder.empty() && ::chdir(setup.folder.c_str()) != 0) ::_exit(127);
  // Ours first: the caller may set it otherwise.
  ::putenv(kDebugVariable);
  for (const std::string& variable : setup.environment)
    ::putenv(const_cast<char*>(variable.c_str()));
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

RunningProgram::~RunningProgram() {
  if (pid_ < 0) return;
  signal(SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void RunningProgram::signal(int number) const {
  ::kill(pid_, number);
}

ProgramResult RunningProgram::wait() {
  int status = 0;
  rusage usage = {};
  ::wait4(pid_, &status, 0, &usage);
  pid_ = -1;
  ProgramResult result;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.standardOutput = textOf(*folder_ / "out");
  result.standardError = textOf(*folder_ / "err");
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peakBytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return result;
}

ProgramResult runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                         const ProgramSetup& setup) {
  RunningProgram running(program, arguments, setup);
  if (setup.signalAfter.count() > 0) {
    std::this_thread::sleep_for(setup.signalAfter);
    running.signal(setup.signal);
  }
  return running.wait();
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "jalousie-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::optional<std::filesystem::path> findProgram(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code ignored;
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return std::nullopt;
}

}  // namespace jalousie::test
