// One program at a time in a folder.
#pragma once

#include <filesystem>

#include "core/descriptor.h"

namespace jalousie {

/// A lock on an existing folder for as long as the object lives. The kernel releases it when the process ends, however
/// it ends, and no file is left behind. File systems without locks on folders (some network file systems) give none.
class FolderLock {
 public:
  /// Does not wait. Errors: kWriteFailed if another process holds the lock, or the folder cannot be opened.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

}  // namespace jalousie
