// Notices that files change, by their time and size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace jalousie::app {

/// Looks at a file, or at every file of a folder and below. What is asked for is remembered between calls.
class FileWatch {
 public:
  FileWatch() = default;
  explicit FileWatch(std::filesystem::path path);

  /// Whether anything differs from the last call (or the constructor), and has stayed the same since the call before:
  /// a file that is still being written is not reported yet.
  bool changed();

 private:
  struct Stamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::filesystem::path, Stamp>;
  Stamps look() const;

  std::filesystem::path path_;
  Stamps reported_;
  Stamps last_;
};

}  // namespace jalousie::app
