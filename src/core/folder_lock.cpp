// flock on the folder itself.
#include "core/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace jalousie {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (!folder_.valid()) throw Error(ErrorCode::kWriteFailed, std::strerror(errno), folder);
  if (::flock(folder_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(ErrorCode::kWriteFailed, "another run is using this folder; wait for it or choose another folder",
                folder);
}

}  // namespace jalousie
