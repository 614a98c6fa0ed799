// Which files a program opens: the program is traced, so other programs on the machine do not matter.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace jalousie::test {

/// Runs `program ARGUMENT...` without a shell and with its outputs discarded, and waits for it.
/// @return real paths of all files and folders that it and its children opened, by whatever function, links followed;
/// nullopt where tracing is forbidden
/// The caller must have no other children meanwhile. LeakSanitizer is off in the program: it cannot work when traced.
std::optional<std::set<std::filesystem::path>> filesOpenedBy(const std::filesystem::path& program,
                                                             const std::vector<std::string>& arguments);

}  // namespace jalousie::test
