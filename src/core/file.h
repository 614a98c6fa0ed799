// Whole files in, whole files out: reads are capped, writes appear in one step.
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

/// The folder a file lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& file);

/// Replaces path by bytes: written to a file in the same folder that has no name yet, synced, named, folder synced. A
/// reader sees the old file or the new one, never a part, and a program that is killed meanwhile leaves nothing behind
/// (on file systems without unnamed files: a file that removeAbandonedFiles removes). A link is followed; a device or a
/// pipe stays what it is and is written to. Errors: kWriteFailed; the old file is then intact.
void writeFileAtomic(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomic(const std::filesystem::path& path, std::string_view text);

/// Removes what killed programs of this machine left of unfinished writes to files in this folder; files that somebody
/// is writing now stay. Never throws: a folder that cannot be read has nothing to remove.
void removeAbandonedFiles(const std::filesystem::path& folder) noexcept;

/// Adds text to a file that exists, and waits until it is on the disk. Errors: kWriteFailed; a part may be written.
void appendToFile(const std::filesystem::path& path, std::string_view text);

}  // namespace jalousie
