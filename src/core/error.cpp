// Messages of jalousie::Error are kept to one line so that scripts can read them.
#include "core/error.h"

namespace jalousie {
std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.pop_back();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool isC1 = c >= 0x80 && c < 0xA0 && i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC2;
    if (c < 0x20 || c == 0x7F) text[i] = ' ';
    if (isC1) text.replace(i - 1, 2, "  ");
  }
  return text;
}

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
