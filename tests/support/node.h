// Node.js, if this machine has it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

namespace jalousie::test {

/// The program, found along PATH.
inline std::optional<std::filesystem::path> findNode() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / "node")) return std::filesystem::path(folder) / "node";
  return std::nullopt;
}

}  // namespace jalousie::test
