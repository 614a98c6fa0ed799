// openat2 with RESOLVE_BENEATH: the kernel refuses whatever would leave the folder, races with renames included. Older
// kernels get a walk that refuses every link.
#include "core/confined_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/file_read.h"

namespace jalousie {
namespace {

std::vector<std::string> components(const std::string& name) {
  std::vector<std::string> parts;
  std::string part;
  for (const char c : name + '/') {
    if (c != '/') {
      part += c;
    } else {
      if (!part.empty() && part != ".") parts.push_back(part);
      part.clear();
    }
  }
  return parts;
}

/// Whether the name alone, links aside, stays inside. What does not is not even looked for.
bool staysInside(const std::string& name) {
  if (name.starts_with('/')) return false;
  int depth = 0;
  for (const std::string& part : components(name)) {
    depth += part == ".." ? -1 : 1;
    if (depth < 0) return false;
  }
  return true;
}

}  // namespace

ConfinedFolder::ConfinedFolder(std::filesystem::path folder, Lookup lookup)
    : folder_(std::move(folder)),
      lookup_(lookup),
      descriptor_(::open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_.valid()) return;
  const bool absent = errno == ENOENT || errno == ENOTDIR;
  throw Error(absent ? ErrorCode::kFileNotFound : ErrorCode::kFileUnreadable, std::strerror(errno), folder_);
}

std::vector<std::byte> ConfinedFolder::readFile(const std::string& name, std::uint64_t maxBytes) const {
  const std::filesystem::path path = folder_ / name;
  if (name.empty() || name.find('\0') != std::string::npos)
    throw Error(ErrorCode::kMalformed, "a name of a file is empty or holds a zero byte", folder_);
  if (!staysInside(name)) throw Error(ErrorCode::kUnsupported, "leaves the folder it was named in", path);
  int fd = -1;
  if (lookup_ == Lookup::kKernel) fd = openByKernel(name);
  // Some containers answer EPERM to system calls they do not know.
  if (lookup_ == Lookup::kByComponent || (fd < 0 && (errno == ENOSYS || errno == EPERM))) fd = openByComponent(name);
  const Descriptor file(fd);
  if (!file.valid()) {
    const bool linkRefused = errno == ELOOP && lookup_ == Lookup::kByComponent;
    if (errno == EXDEV || linkRefused)
      throw Error(ErrorCode::kUnsupported, "leaves the folder it was named in, through a link", path);
    if (errno == ENOENT || errno == ENOTDIR) throw Error(ErrorCode::kFileNotFound, "no such file", path);
    throw Error(ErrorCode::kFileUnreadable, std::strerror(errno), path);
  }
  return detail::readOpened(file, path, maxBytes);
}

int ConfinedFolder::openByKernel(const std::string& name) const {
  open_how how = {};
  how.flags = static_cast<std::uint64_t>(detail::readFlags());
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  long fd = -1;
  int attempts = 0;
  do {  // EAGAIN: something was renamed while ".." was followed
    fd = ::syscall(SYS_openat2, descriptor_.get(), name.c_str(), &how, sizeof how);
  } while (fd < 0 && (errno == EAGAIN || errno == EINTR) && ++attempts < 100);
  return static_cast<int>(fd);
}

int ConfinedFolder::openByComponent(const std::string& name) const {
  std::vector<Descriptor> open;  // folders below ours on the way to the file
  const std::vector<std::string> parts = components(name);
  const auto here = [&] { return open.empty() ? descriptor_.get() : open.back().get(); };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i] == "..") {
      open.pop_back();  // staysInside has seen that there is one
      continue;
    }
    const bool last = i + 1 == parts.size();
    const int flags = last ? detail::readFlags() : O_PATH | O_DIRECTORY | O_CLOEXEC;
    const int fd = ::openat(here(), parts[i].c_str(), flags | O_NOFOLLOW);
    if (fd < 0 && errno == ENOTDIR && !last) {  // a link to a folder, too
      struct stat info = {};
      const bool isLink = ::fstatat(here(), parts[i].c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(info.st_mode);
      errno = isLink ? ELOOP : ENOTDIR;
    }
    if (fd < 0 || last) return fd;
    open.emplace_back(fd);
  }
  errno = EISDIR;
  return -1;
}

}  // namespace jalousie
