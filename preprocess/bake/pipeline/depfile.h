// Writes dependencies as rules for Make and Ninja.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jalousie::bake {

/// One rule, "OUTPUT: FILE FILE ...", with names escaped. Errors: kUsage (a name with a line break cannot be written).
std::string depfileRule(const std::filesystem::path& output, const std::vector<std::filesystem::path>& files);

}  // namespace jalousie::bake
