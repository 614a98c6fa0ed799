// Runs one of the project's programs and collects what it said.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace jalousie::test {

struct ProgramResult {
  int exitCode = -1;  ///< 128 + signal number if a signal ended it
  std::string standardOutput;
  std::string standardError;
  double cpuSeconds = 0.0;      ///< of the program and the processes it waited for
  std::uint64_t peakBytes = 0;  ///< resident memory of the largest of them
};

/// Where a program's standard output goes.
enum class StandardOutput {
  kCollected,
  kFull,      ///< /dev/full: every write fails
  kClosed,    ///< no open file
  kNoReader,  ///< a pipe that nobody reads
};

struct ProgramSetup {
  std::vector<std::string> environment = {};  ///< "NAME=VALUE", added to ours and to JALOUSIE_GL_DEBUG=1
  std::filesystem::path folder = {};          ///< to run in; empty: ours
  std::chrono::milliseconds signalAfter{0};   ///< 0: never; counted from the start
  int signal = 9;
  StandardOutput output = StandardOutput::kCollected;
  int ignoredSignal = 0;  ///< ignored when the program starts, as nohup does; 0: none
};

class TemporaryFolder;

/// `program ARGUMENT...`, started without a shell. A message of an OpenGL debug context, of medium or high severity,
/// gives jalousie the exit code 70.
class RunningProgram {
 public:
  RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const ProgramSetup& setup = {});
  /// Kills the program if wait was not called.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void signal(int number) const;
  /// Waits for the end. Call it once.
  ProgramResult wait();

 private:
  std::unique_ptr<TemporaryFolder> folder_;  ///< of the collected output
  int pid_ = -1;
};

/// Runs a program, sends it the signal of the setup, and waits for it.
ProgramResult runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                         const ProgramSetup& setup = {});

/// A fresh folder below the system's temporary one, removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The file that a shell would run: the first of this name in the folders of PATH.
std::optional<std::filesystem::path> findProgram(const std::string& name);

}  // namespace jalousie::test
