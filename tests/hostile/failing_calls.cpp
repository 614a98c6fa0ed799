// LD_PRELOAD: JALOUSIE_FAIL=write:3 makes the third write to a regular file fail with ENOSPC; likewise fsync, linkat
// and rename. Counts in each process.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

/// Whether this call of a function is the one that fails.
bool failsNow(const char* name) {
  static int calls = 0;
  const char* wanted = std::getenv("JALOUSIE_FAIL");
  const std::size_t length = std::strlen(name);
  if (wanted == nullptr || std::strncmp(wanted, name, length) != 0 || wanted[length] != ':') return false;
  return ++calls == std::atoi(wanted + length + 1);
}

bool isRegular(int file) {
  struct stat info = {};
  return ::fstat(file, &info) == 0 && S_ISREG(info.st_mode);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  if (isRegular(file) && failsNow("write")) {
    errno = ENOSPC;
    return -1;
  }
  return next<ssize_t (*)(int, const void*, size_t)>("write")(file, data, size);
}

int fsync(int file) {
  if (failsNow("fsync")) {
    errno = EIO;
    return -1;
  }
  return next<int (*)(int)>("fsync")(file);
}

int linkat(int fromFolder, const char* from, int toFolder, const char* to, int flags) {
  if (failsNow("linkat")) {
    errno = ENOSPC;
    return -1;
  }
  return next<int (*)(int, const char*, int, const char*, int)>("linkat")(fromFolder, from, toFolder, to, flags);
}

int rename(const char* from, const char* to) {
  if (failsNow("rename")) {
    errno = EIO;
    return -1;
  }
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}
}
