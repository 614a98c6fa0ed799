// The bytes a glTF document points to: external files confined to its folder, data URIs, the binary chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf_file.h"
#include "core/confined_folder.h"

namespace jalousie::asset::detail {

/// Loads what URIs name. All resources of a document together stay below Limits::maxFileBytes.
class ResourceLoader {
 public:
  ResourceLoader(std::filesystem::path document, const Limits& limits, ReadObserver observer);

  /// Errors: kFileNotFound, kFileUnreadable, kMalformed (bad encoding), kUnsupported (a scheme other than data, a path
  /// that leaves the document's folder, through a link too), kLimit.
  std::vector<unsigned char> load(const std::string& uri);
  /// A copy of bytes that are in memory already, counted like a file.
  std::vector<unsigned char> copy(std::span<const std::byte> bytes);

 private:
  std::vector<std::byte> readNamed(const std::string& uri);
  void account(std::uint64_t bytes);

  std::filesystem::path document_;
  ReadObserver observer_;
  std::optional<ConfinedFolder> folder_;  ///< opened for the first file
  std::uint64_t maxBytes_;
  std::uint64_t usedBytes_ = 0;
};

/// "image/png", "image/jpeg", or empty for anything else, by the first bytes.
std::string sniffMimeType(std::span<const unsigned char> bytes);

}  // namespace jalousie::asset::detail
