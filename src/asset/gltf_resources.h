// Loads the bytes that a glTF document refers to: external files in its folder, data URIs, the binary chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/read_limits.h"
#include "core/confined_folder.h"

namespace jalousie::asset::detail {

/// Loads the resources that URIs name. All resources of a document together stay below Limits::maxFileBytes, and copies
/// of the same bytes below a multiple of what the document brings.
class ResourceLoader {
 public:
  ResourceLoader(std::filesystem::path document, const Limits& limits, ReadObserver observer);

  /// Errors: kFileNotFound, kFileUnreadable, kMalformed (bad encoding), kUnsupported (a scheme other than data, a path
  /// that leaves the document's folder, through a link too), kLimit.
  std::vector<unsigned char> load(const std::string& uri);
  /// A copy of bytes that are in memory already, counted like a file. @param isNew  not part of anything counted before
  std::vector<unsigned char> copy(std::span<const std::byte> bytes, bool isNew);

 private:
  std::vector<std::byte> readNamed(const std::string& uri);
  void account(std::uint64_t bytes, bool isNew);

  std::filesystem::path document_;
  ReadObserver observer_;
  std::optional<ConfinedFolder> folder_;  ///< opened for the first file
  std::uint64_t maxBytes_;
  std::uint64_t usedBytes_ = 0;
  std::uint64_t givenBytes_ = 0;  ///< of these, those that came with the document, each once
  std::set<std::string> seen_;    ///< names of files
};

}  // namespace jalousie::asset::detail
