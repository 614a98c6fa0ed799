// Messages of jalousie::Error are kept to one line so that scripts can read them.
#include "core/error.h"

#include <algorithm>

namespace jalousie {
namespace {

std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.pop_back();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace

std::string_view errorName(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return "usage";
    case ErrorCode::kFileNotFound:
      return "file-not-found";
    case ErrorCode::kFileUnreadable:
      return "file-unreadable";
    case ErrorCode::kMalformed:
      return "malformed";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kLimit:
      return "limit";
    case ErrorCode::kWriteFailed:
      return "write-failed";
    case ErrorCode::kNoGpu:
      return "no-gpu";
    case ErrorCode::kShader:
      return "shader";
    case ErrorCode::kSomeFailed:
      return "some-failed";
    case ErrorCode::kInternal:
      return "internal";
  }
  return "unknown";
}

Error::Error(ErrorCode code, const std::string& message, const std::filesystem::path& file)
    : std::runtime_error(oneLine(file.empty() ? message : file.string() + ": " + message)), code_(code), file_(file) {}

}  // namespace jalousie
