// Finds the files to bake from the arguments of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jalousie::bake {

/// A file to bake. `relative` is its place below the folder or pattern that named it, or its name.
struct InputFile {
  std::filesystem::path path;
  std::filesystem::path relative;
};

/// Files stay; folders give all .ply, .obj, .stl, .gltf and .glb files below them; patterns with *, ?, [...] and **
/// (any number of folders) the files they match. Sorted by path within each argument, duplicates removed. Hidden files,
/// links and everything in the folders `except` are skipped.
/// Errors: kFileNotFound (a pattern or folder with no files), kFileUnreadable.
std::vector<InputFile> findInputs(const std::vector<std::string>& arguments,
                                  const std::vector<std::filesystem::path>& except = {});

/// The files of a list, unchanged and without a check that they exist: lists are made by programs. The `relative` of a
/// relative path is the path itself.
std::vector<InputFile> listedInputs(const std::vector<std::string>& files);

/// One path a line. @param file  "-" reads standard input. Errors: those of readFile.
std::vector<std::string> readList(const std::filesystem::path& file);

/// The absolute path without links, as far as the path exists.
std::filesystem::path canonicalPath(const std::filesystem::path& path);

}  // namespace jalousie::bake
