// Whole files in, whole files out: reads are capped, writes land beside the target and are renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace jalousie {

/// Reads a regular file of at most maxBytes.
/// Errors: kFileNotFound; kFileUnreadable (a folder, a device, no permission); kLimit (larger than maxBytes).
std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t maxBytes);

/// Replaces path by bytes: written to a temporary file in the same folder, synced, renamed. A reader sees the old file
/// or the new one, never a part. Errors: kWriteFailed; the old file is then intact and the temporary one is gone.
void writeFileAtomic(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomic(const std::filesystem::path& path, std::string_view text);

/// Adds text to a file that exists, and waits until it is on the disk. Errors: kWriteFailed; a part may be written.
void appendToFile(const std::filesystem::path& path, std::string_view text);

}  // namespace jalousie
