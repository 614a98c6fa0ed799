// Where the repository's own files lie.
#pragma once

#include <filesystem>

namespace jalousie::test {

inline const std::filesystem::path kSourceRoot = JALOUSIE_SOURCE_DIR;

}  // namespace jalousie::test
