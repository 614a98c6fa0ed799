// Compares files by device and inode, so that links and other spellings of a path count as the same file.
#include "core/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/descriptor.h"
#include "core/error.h"
#include "core/file.h"
#include "core/standard_streams.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

bool isStdout(const NamedFile& file) {
  return file.mayBeStdout && file.path == kStandardOutput;
}

bool statusOf(const NamedFile& file, struct stat& status) {
  return isStdout(file) ? ::fstat(STDOUT_FILENO, &status) == 0 : ::stat(file.path.c_str(), &status) == 0;
}

/// Whether two files are one, or will be. Devices can be written any number of times.
bool isSame(const NamedFile& a, const NamedFile& b) {
  struct stat ofA = {};
  struct stat ofB = {};
  const bool hasA = statusOf(a, ofA);
  const bool hasB = statusOf(b, ofB);
  if (isStdout(a) && isStdout(b)) return true;
  if (hasA != hasB) return false;
  if (hasA) return ofA.st_dev == ofB.st_dev && ofA.st_ino == ofB.st_ino && !S_ISCHR(ofA.st_mode);
  std::error_code failed;
  return fs::weakly_canonical(fs::absolute(a.path), failed) == fs::weakly_canonical(fs::absolute(b.path), failed);
}

/// Reason why no new file can be made in a folder; 0 if one can.
int refusalOf(const fs::path& folder) {
  const Descriptor file(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  if (file.valid()) return 0;
  const bool isUnknown = errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL;  // no unnamed files here
  if (!isUnknown) return errno;
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

void checkWritable(const NamedFile& output) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::kWriteFailed, fmt::format("{} ({})", reason, output.option), output.path);
  };
  std::error_code failed;
  const fs::file_status status = fs::status(output.path, failed);
  if (fs::is_directory(status) || !output.path.has_filename()) refuse("is a folder and not a file");
  if (fs::exists(status) && fs::is_other(status)) {
    if (::access(output.path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
    return;
  }
  const bool isLink = fs::is_symlink(output.path, failed) && fs::exists(status);
  const fs::path folder = folderOf(isLink ? fs::canonical(output.path, failed) : output.path);
  if (!fs::exists(folder, failed)) refuse(fmt::format("the folder {} does not exist", folder.string()));
  if (!fs::is_directory(folder, failed)) refuse(fmt::format("{} is not a folder", folder.string()));
  if (const int reason = refusalOf(folder); reason != 0)
    refuse(fmt::format("the folder {} cannot be written: {}", folder.string(), std::strerror(reason)));
}

}  // namespace

void requireReplaceable(const NamedFile& output) {
  std::error_code failed;
  if (output.kind == OutputKind::kAny || !fs::is_regular_file(output.path, failed)) return;
  if (fs::file_size(output.path, failed) == 0) return;
  const OutputKind existing = kindOfFile(output.path);
  if (existing == output.kind) return;
  throw Error(ErrorCode::kUsage,
              fmt::format("{} exists here and would be replaced by {} ({}); name another file, or add --force",
                          nameOf(existing), nameOf(output.kind), output.option),
              output.path);
}

void checkOutputs(std::span<const NamedFile> outputs, std::span<const fs::path> inputs, Replace replace) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    if (output.path == kStandardOutput && !output.mayBeStdout)
      throw Error(ErrorCode::kUsage, fmt::format("{} -: this output cannot go to standard output; name a file (./- for "
                                                 "a file with the name -)",
                                                 output.option));
    for (const NamedFile& other : outputs.first(i))
      if (!other.path.empty() && isSame(output, other))
        throw Error(ErrorCode::kUsage, fmt::format("{} and {} name the same file", other.option, output.option),
                    output.path);
    for (const fs::path& input : inputs)
      if (!input.empty() && isSame(output, {.option = "", .path = input}))
        throw Error(ErrorCode::kUsage, fmt::format("{} names an input file; choose another output", output.option),
                    output.path);
    if (isStdout(output)) continue;
    checkWritable(output);
    if (replace == Replace::kAnything) continue;
    requireReplaceable(output);
    if (hasForeignExtension(output.path, output.kind)) {
      throw Error(
          ErrorCode::kUsage,
          fmt::format("the output is {}; give it a name that ends in {}, not {} ({}), or add --force",
                      nameOf(output.kind), extensionOf(output.kind), output.path.extension().string(), output.option),
          output.path);
    }
  }
}

void writeText(const fs::path& path, std::string_view text) {
  if (path == kStandardOutput) {
    printOutput(text);
  } else {
    writeFileAtomic(path, text);
  }
}

}  // namespace jalousie
