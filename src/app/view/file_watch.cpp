// Polling: it works on every file system, and a few files a second cost nothing.
#include "app/view/file_watch.h"

namespace jalousie::app {

FileWatch::FileWatch(std::filesystem::path path) : path_(std::move(path)), reported_(look()), last_(reported_) {}

FileWatch::Stamps FileWatch::look() const {
  namespace fs = std::filesystem;
  Stamps stamps;
  std::error_code failed;
  const auto add = [&](const fs::path& file) {
    const Stamp stamp{fs::last_write_time(file, failed), fs::file_size(file, failed)};
    if (!failed) stamps[file] = stamp;
  };
  if (fs::is_directory(path_, failed)) {
    for (auto it = fs::recursive_directory_iterator(path_, failed); !failed && it != fs::end(it); it.increment(failed))
      if (it->is_regular_file(failed)) add(it->path());
  } else if (!path_.empty()) {
    add(path_);
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
