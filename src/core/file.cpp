// POSIX file access with the checks in core/file.h.
#include "core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace jalousie {
namespace {

/// An open file descriptor; closed on destruction.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  /// Closes and tells whether the file system accepted everything (close may report a late write error).
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool writeAll(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid()) {
    if (errno == ENOENT || errno == ENOTDIR) throw Error(ErrorCode::kFileNotFound, "no such file", path);
    throw Error(ErrorCode::kFileUnreadable, std::strerror(errno), path);
  }
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

void writeFileAtomic(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::filesystem::path target = path.empty() ? std::filesystem::path(".") : path;
  std::string temporary = target.string() + ".XXXXXX";
  Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (!file.valid())
    throw Error(ErrorCode::kWriteFailed, fmt::format("cannot write here: {}", std::strerror(errno)), path);

  const auto fail = [&](int reason) {
    ::unlink(temporary.c_str());
    throw Error(ErrorCode::kWriteFailed, std::strerror(reason), path);
  };
  // mkostemp creates private files; give the result the permissions any new file would have.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (!writeAll(file.get(), bytes) || ::fchmod(file.get(), 0666 & ~mask) != 0 || ::fsync(file.get()) != 0) fail(errno);
  if (!file.close()) fail(errno);
  if (::rename(temporary.c_str(), target.c_str()) != 0) fail(errno);

  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.valid()) ::fsync(directory.get());
}

void writeFileAtomic(const std::filesystem::path& path, std::string_view text) {
  writeFileAtomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

void appendToFile(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const bool written = file.valid() && writeAll(file.get(), std::as_bytes(std::span(text.data(), text.size()))) &&
                       ::fdatasync(file.get()) == 0;
  if (!written) throw Error(ErrorCode::kWriteFailed, std::strerror(errno != 0 ? errno : ENOSPC), path);
}

}  // namespace jalousie
