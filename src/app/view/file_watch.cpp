// Detects changes of files by polling, which works on every file system and is cheap for a few files a second.
#include "app/view/file_watch.h"

namespace jalousie::app {

void FileWatch::watch(std::vector<std::filesystem::path> paths) {
  paths_ = std::move(paths);
  Stamps now = look();
  for (auto& [file, stamp] : now)
    if (const auto known = reported_.find(file); known != reported_.end()) stamp = known->second;
  reported_ = now;
  last_ = std::move(now);
}

FileWatch::Stamps FileWatch::look() const {
  namespace fs = std::filesystem;
  Stamps stamps;
  std::error_code failed;
  const auto add = [&](const fs::path& file) {
    std::error_code missing;
    const auto time = fs::last_write_time(file, missing);
    const std::uintmax_t size = missing ? 0 : fs::file_size(file, missing);
    if (!missing) stamps[file] = {time, size};
  };
  for (const fs::path& path : paths_) {
    if (!recursive_ || !fs::is_directory(path, failed)) {
      add(path);
      continue;
    }
    for (auto it = fs::recursive_directory_iterator(path, failed); !failed && it != fs::end(it); it.increment(failed))
      if (it->is_regular_file(failed)) add(it->path());
  }
  return stamps;
}

bool FileWatch::changed() {
  Stamps now = look();
  const bool settled = now == last_;
  last_ = std::move(now);
  if (!settled || last_ == reported_) return false;
  reported_ = last_;
  return true;
}

}  // namespace jalousie::app
