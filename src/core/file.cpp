// POSIX file access with the checks in core/file.h.
#include "core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/file_read.h"
#include "core/interruption.h"

namespace jalousie {
namespace {

/// How the names of unfinished files begin: locks may not reach other machines that share the folder.
std::string partPrefix() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return fmt::format(".jalousie-{}-", host);
}

/// Whether a name is one of partPrefix, digits, "-", digits.
bool isPartName(const std::string& name) {
  const std::string prefix = partPrefix();
  if (!name.starts_with(prefix)) return false;
  const std::string rest = name.substr(prefix.size());
  const std::size_t dash = rest.find('-');
  return dash != std::string::npos && dash > 0 && dash + 1 < rest.size() &&
         rest.find_first_not_of("0123456789-") == std::string::npos && rest.find('-', dash + 1) == std::string::npos;
}

bool writeAll(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool isSameFile(int fd, const char* path) {
  struct stat open = {};
  struct stat named = {};
  return ::fstat(fd, &open) == 0 && ::lstat(path, &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

/// A file on its way to its name. While it has a name of its own it is locked, which tells removeAbandonedFiles that
/// its writer is alive; a process that dies lets go of the lock. Meanwhile signals wait, so that none leaves the file.
class StagedFile {
 public:
  explicit StagedFile(std::filesystem::path target) : target_(std::move(target)), folder_(folderOf(target_)) {
    file_ = Descriptor(::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
    if (!file_.valid() && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL)) openNamed();
    if (!file_.valid())
      throw Error(ErrorCode::kWriteFailed, fmt::format("cannot write here: {}", std::strerror(errno)), target_);
  }
  ~StagedFile() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  void write(std::span<const std::byte> bytes) {
    // Staged files are private; give the result the permissions any new file would have.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (!writeAll(file_.get(), bytes) || ::fchmod(file_.get(), 0666 & ~mask) != 0 || ::fsync(file_.get()) != 0) fail();
  }

  /// Puts the file in its target's place.
  void commit() {
    if (!name_.empty() || !linkTo(target_.string())) {
      if (name_.empty()) nameIt();
      if (::rename(name_.c_str(), target_.c_str()) != 0) fail();
      name_.clear();
      held_.reset();
    }
    const Descriptor directory(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.valid() && ::fsync(directory.get()) != 0 && errno != EINVAL) fail();
  }

 private:
  [[noreturn]] void fail() const { throw Error(ErrorCode::kWriteFailed, std::strerror(errno), target_); }

  std::string partName(int attempt) const {
    return (folder_ / fmt::format("{}{}-{}", partPrefix(), ::getpid(), attempt)).string();
  }

  void openNamed() {
    held_.emplace();
    for (int attempt = 0; attempt < kAttempts && !file_.valid(); ++attempt) {
      const std::string name = partName(attempt);
      file_ = Descriptor(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
      if (!file_.valid() && errno != EEXIST) return;
      if (!file_.valid()) continue;
      ::flock(file_.get(), LOCK_EX | LOCK_NB);
      if (!isSameFile(file_.get(), name.c_str())) {  // cleaned away before it was locked
        file_.close();
        continue;
      }
      name_ = name;
    }
  }

  bool linkTo(const std::string& path) const {
    const std::string open = fmt::format("/proc/self/fd/{}", file_.get());
    return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
  }

  /// Gives an unnamed file a name, from which it can be renamed over an existing target.
  void nameIt() {
    if (errno != EEXIST) fail();
    held_.emplace();
    ::flock(file_.get(), LOCK_EX | LOCK_NB);
    for (int attempt = 0; name_.empty(); ++attempt) {
      if (linkTo(partName(attempt))) {
        name_ = partName(attempt);
      } else if (errno != EEXIST || attempt == kAttempts) {
        fail();
      }
    }
  }

  static constexpr int kAttempts = 1000;
  std::filesystem::path target_;
  std::filesystem::path folder_;
  Descriptor file_;
  std::string name_;  ///< of its own; empty while it has none
  std::optional<HeldInterruptions> held_;
};

/// Writes to what is there and no file: /dev/stdout, a pipe.
void writeToDevice(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.valid() || !writeAll(file.get(), bytes)) throw Error(ErrorCode::kWriteFailed, std::strerror(errno), path);
}

}  // namespace

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

namespace detail {

int readFlags() {
  return O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
}

std::vector<std::byte> readOpened(const Descriptor& file, const std::filesystem::path& path, std::uint64_t maxBytes) {
  struct stat info = {};
  if (::fstat(file.get(), &info) != 0) throw Error(ErrorCode::kFileUnreadable, std::strerror(errno), path);
  if (!S_ISREG(info.st_mode)) throw Error(ErrorCode::kFileUnreadable, "not a regular file", path);
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size > maxBytes)
    throw Error(ErrorCode::kLimit, fmt::format("file has {} bytes, the limit is {}", size, maxBytes), path);

  std::vector<std::byte> bytes(size);
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(ErrorCode::kFileUnreadable, std::strerror(errno), path);
    if (got == 0) throw Error(ErrorCode::kFileUnreadable, "file shrank while it was read", path);
    filled += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace detail

std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
  const Descriptor file(::open(path.c_str(), detail::readFlags()));
  if (!file.valid()) {
    if (errno == ENOENT || errno == ENOTDIR) throw Error(ErrorCode::kFileNotFound, "no such file", path);
    throw Error(ErrorCode::kFileUnreadable, std::strerror(errno), path);
  }
  return detail::readOpened(file, path, maxBytes);
}

void writeFileAtomic(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::path target = path.empty() ? std::filesystem::path(".") : path;
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(target, failed);
  if (std::filesystem::exists(status) && std::filesystem::is_other(status)) return writeToDevice(target, bytes);
  if (std::filesystem::is_symlink(target, failed) && std::filesystem::exists(status))
    target = std::filesystem::canonical(target);
  StagedFile file(target);
  file.write(bytes);
  file.commit();
}

void writeFileAtomic(const std::filesystem::path& path, std::string_view text) {
  writeFileAtomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

void removeAbandonedFiles(const std::filesystem::path& folder) noexcept {
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (!isPartName(entry.path().filename().string()) || !entry.is_regular_file()) continue;
      const Descriptor file(::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
      if (file.valid() && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 && isSameFile(file.get(), entry.path().c_str()))
        ::unlink(entry.path().c_str());
    }
  } catch (const std::exception&) {
    return;
  }
}

void appendToFile(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const bool written = file.valid() && writeAll(file.get(), std::as_bytes(std::span(text.data(), text.size()))) &&
                       ::fdatasync(file.get()) == 0;
  if (!written) throw Error(ErrorCode::kWriteFailed, std::strerror(errno != 0 ? errno : ENOSPC), path);
}

}  // namespace jalousie
