// Detects changes of files by their modification time and size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace jalousie::app {

/// Watches files, or all files of a folder and its subfolders, by polling.
class FileWatch {
 public:
  FileWatch() = default;
  /// @param recursive  a folder stands for all files in it and its subfolders
  explicit FileWatch(const std::filesystem::path& path, bool recursive = false) : recursive_(recursive) {
    watch({path});
  }

  /// Replaces the watched paths. For a path that was watched before, the state that changed() reported last stays the
  /// reference; for a new path, the state of this moment is.
  void watch(std::vector<std::filesystem::path> paths);

  /// Whether anything differs from the state reported last and has stayed the same since the last call, so that a file
  /// is not reported while it is being written.
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
