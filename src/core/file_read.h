// What every reader of whole files does once the file is open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/descriptor.h"

namespace jalousie::detail {

/// Flags for opening a file that may be anything: a pipe must not block us, a terminal must not become ours.
int readFlags();
/// The content of an open regular file. @param path  for messages. Errors: kFileUnreadable, kLimit.
std::vector<std::byte> readOpened(const Descriptor& file, const std::filesystem::path& path, std::uint64_t maxBytes);

}  // namespace jalousie::detail
