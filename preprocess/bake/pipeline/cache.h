// Cache of baked results, addressed by the content of the inputs and the options.
//
// DIR/entries/KK/KEY/VARIANT.json   KEY: SHA-256 of the identity, and names and bytes of the inputs. There is one
//                                   variant for each set of side files (buffers, images, materials) read with them:
//   {"format": 1, "read": [{"input": 0, "name": "wood.png", "sha256": "..." or null if there was no such file}, ...],
//    "output": "SHA-256", "sheet": "SHA-256" or null, "report": "...", "table": "..."}
// DIR/objects/HH/SHA-256            outputs and sheets
//
// Every file is written once and atomically, under a name that is a hash of its content, so any number of processes on
// any number of machines may share a folder. A file whose content does not match its name is not used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/pipeline/bake_job.h"

namespace jalousie::bake {

struct CacheEntry {
  std::vector<std::byte> output;
  std::vector<std::byte> sheet;  ///< empty if none was asked for
  std::string report;
  std::string table;
};

class Cache {
 public:
  /// @param identity  of program and options
  Cache(std::filesystem::path folder, std::string identity);

  /// The result of an earlier bake of a job. Inputs are hashed, not parsed. @param read  gets the files it was made of
  /// Errors: those of readFile for the inputs. A damaged or missing cache is a miss.
  std::optional<CacheEntry> find(const BakeJob& job, const asset::Limits& limits, std::vector<ReadFile>& read) const;
  /// Errors: kWriteFailed.
  void store(const BakeJob& job, const std::vector<ReadFile>& read, const CacheEntry& entry) const;

 private:
  std::filesystem::path entryFolder(const BakeJob& job, const std::vector<ReadFile>& inputs) const;
  std::filesystem::path objectPath(const std::string& sha256) const;
  std::optional<std::vector<std::byte>> object(const std::string& sha256) const;
  void storeObject(const std::string& sha256, std::span<const std::byte> bytes) const;

  std::filesystem::path folder_;
  std::string identity_;
};

/// Removes the least recently used files until the folder holds at most maxBytes. Never throws: if the cache cannot be
/// trimmed, it stays larger.
void trimCache(const std::filesystem::path& folder, std::uint64_t maxBytes) noexcept;

}  // namespace jalousie::bake
