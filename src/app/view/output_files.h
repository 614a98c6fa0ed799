// Names of the files that the viewer writes.
#pragma once

#include <filesystem>

namespace jalousie::app {

/// FOLDER/STEM-0001EXTENSION, with the first number for which there is no file.
/// @param folder  empty: the current folder   @param extension  with its dot
std::filesystem::path freshOutput(const std::filesystem::path& folder, const char* stem, const char* extension);

}  // namespace jalousie::app
