// Notices that files change, by their time and size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace jalousie::app {

/// Looks at files, or at every file of a folder and below. What is asked for is remembered between calls.
class FileWatch {
 public:
  FileWatch() = default;
  /// @param recursive  a folder stands for all files in it and below
  explicit FileWatch(const std::filesystem::path& path, bool recursive = false) : recursive_(recursive) {
    watch({path});
  }

  /// From now on these. What was watched already keeps what is known of it; what is new counts as it is now.
  void watch(std::vector<std::filesystem::path> paths);

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

  bool recursive_ = false;
  std::vector<std::filesystem::path> paths_;
  Stamps reported_;
  Stamps last_;
};

}  // namespace jalousie::app
