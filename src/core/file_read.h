// Opens and reads whole files; shared by readFile and ConfinedFolder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/descriptor.h"

namespace jalousie::detail {

/// Flags for opening a file of any kind: opening a pipe does not block, and a terminal does not become the program's.
int readFlags();
/// The content of an open regular file. @param path  for messages. Errors: kFileUnreadable, kLimit.
std::vector<std::byte> readOpened(const Descriptor& file, const std::filesystem::path& path, std::uint64_t maxBytes);

}  // namespace jalousie::detail
