// Reads files below a folder by names that come from an untrusted file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/descriptor.h"

namespace jalousie {

/// A folder whose files are read by relative names that cannot lead out of it, neither by ".." nor through a link.
class ConfinedFolder {
 public:
  /// How names are followed: by the kernel (openat2, Linux 5.6), or component by component without any links.
  enum class Lookup { kKernel, kByComponent };

  /// Errors: kFileNotFound, kFileUnreadable.
  explicit ConfinedFolder(std::filesystem::path folder, Lookup lookup = Lookup::kKernel);

  /// Reads a regular file of at most maxBytes. Errors: kMalformed (empty, a zero byte), kUnsupported (leads out of the
  /// folder), kFileNotFound, kFileUnreadable, kLimit.
  std::vector<std::byte> readFile(const std::string& name, std::uint64_t maxBytes) const;

 private:
  int openByKernel(const std::string& name) const;
  int openByComponent(const std::string& name) const;

  std::filesystem::path folder_;
  Lookup lookup_;
  Descriptor descriptor_;
};

}  // namespace jalousie
