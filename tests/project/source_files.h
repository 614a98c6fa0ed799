// The source files that the tests of this folder read.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace jalousie::test {

/// C++ and GLSL files below the given folders of the repository, sorted, with paths from its root.
inline std::vector<std::string> sourceFiles(std::initializer_list<const char*> folders) {
  static const std::set<std::string> kExtensions = {".h", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".tesc", ".tese"};
  const std::filesystem::path root = JALOUSIE_SOURCE_DIR;
  std::vector<std::string> files;
  for (const char* folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && kExtensions.contains(entry.path().extension().string()))
        files.push_back(entry.path().lexically_relative(root).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Text of a file; the path is absolute or starts at the root of the repository.
inline std::string sourceText(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(JALOUSIE_SOURCE_DIR) / file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace jalousie::test
