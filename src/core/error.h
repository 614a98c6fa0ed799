// The one exception type: the world failed (a file, an asset, the driver), not the programmer.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace jalousie {

/// What went wrong. The value is also the exit code of every program, so codes are never renumbered.
enum class ErrorCode : int {
  kUsage = 2,           ///< the command line or the options contradict each other
  kFileNotFound = 3,    ///< the path does not exist
  kFileUnreadable = 4,  ///< it exists but cannot be opened, is no regular file, or reading failed
  kMalformed = 5,       ///< the content breaks its format
  kUnsupported = 6,     ///< valid content this version cannot handle
  kLimit = 7,           ///< refused before allocation: larger or deeper than the limits allow
  kWriteFailed = 8,     ///< the output could not be written; existing files are unchanged
  kNoGpu = 9,           ///< no OpenGL 4.5 context could be made
  kShader = 10,         ///< a shader does not compile or link
  kSomeFailed = 11,     ///< some jobs of a batch failed, each with a code of its own; the others are done
  kInternal = 70,       ///< a defect of ours that was caught
};

/// Stable name of a code, e.g. "malformed"; used in messages and JSON.
std::string_view errorName(ErrorCode code);

/// Text from a file as one line that a terminal may be shown: control characters become spaces.
std::string oneLine(std::string text);

/// An expected failure: code, what happened, and the file it happened in (may be empty).
/// `what()` is one line: "FILE: message".
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, const std::filesystem::path& file = {});
  ErrorCode code() const noexcept { return code_; }
  const std::filesystem::path& file() const noexcept { return file_; }
  int exitCode() const noexcept { return static_cast<int>(code_); }

 private:
  ErrorCode code_;
  std::filesystem::path file_;
};

}  // namespace jalousie
