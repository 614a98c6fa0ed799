// A folder of small meshes, and folders of results compared byte by byte.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/file.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::test {

class BatchFixture : public testing::Test {
 protected:
  BatchFixture() {
    std::filesystem::create_directory(folder_ / "in");
    for (unsigned i = 0; i < 6; ++i)
      std::ofstream(folder_ / ("in/ball" + std::to_string(i) + ".ply")) << spherePly(8 + 2 * i, 5 + i);
    std::ofstream(folder_ / "in/quad.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  /// Name -> content of all files below a folder.
  std::map<std::string, std::vector<std::byte>> contents(const std::string& name) const {
    std::map<std::string, std::vector<std::byte>> result;
    std::error_code absent;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / name, absent))
      if (entry.is_regular_file())
        result[entry.path().lexically_relative(folder_ / name).string()] = readFile(entry.path(), 1U << 30U);
    return result;
  }

  const TemporaryFolder folder_;
};

}  // namespace jalousie::test
