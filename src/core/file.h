// Reads and writes whole files. Reads have a maximum size; writes replace a file atomically.
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

/// Replaces a file by bytes: writes an unnamed file in the same folder, syncs it, gives it the name, syncs the folder.
/// A reader sees the old file or the new one, never a part. A program that is killed meanwhile leaves no file behind,
/// except that SIGKILL can leave one that removeAbandonedFiles removes, where the file system has no unnamed files or a
/// file is replaced. A link is followed; a device or a pipe is written to and not replaced.
/// Errors: kWriteFailed; the old file is then unchanged.
void writeFileAtomic(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomic(const std::filesystem::path& path, std::string_view text);

/// Removes the files that killed programs of this machine left in a folder by unfinished writes. Files that a running
/// program is writing stay. Never throws; does nothing if the folder cannot be read.
void removeAbandonedFiles(const std::filesystem::path& folder) noexcept;

/// Appends text to an existing file and waits until it is on the disk. Errors: kWriteFailed; then a part of the text
/// may be written.
void appendToFile(const std::filesystem::path& path, std::string_view text);

}  // namespace jalousie
