// From what stands on the command line to the files that are baked, and where their results go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/job.h"

namespace jalousie::bake {

/// A file to bake. `relative` is its place below the folder or pattern that named it, or its name.
struct InputFile {
  std::filesystem::path path;
  std::filesystem::path relative;
};

/// Files stay; folders give all .ply, .obj, .gltf and .glb files below them; patterns with *, ?, [...] and ** (any
/// number of folders) the files they match. Sorted by path within each argument, files that come twice only once;
/// hidden files and links found on the way are passed over, and so is everything in the folders `except`.
/// Errors: kFileNotFound (a pattern or folder with no files), kFileUnreadable.
std::vector<InputFile> findInputs(const std::vector<std::string>& arguments,
                                  const std::vector<std::filesystem::path>& except = {});

/// The files of a list, each as it stands there, be it missing: lists are made by programs. A relative path is its
/// place.
std::vector<InputFile> listedInputs(const std::vector<std::string>& files);

/// One path a line. @param file  "-" reads standard input. Errors: those of readFile.
std::vector<std::string> readList(const std::filesystem::path& file);

/// A job for each input, its output at the same place below `folder` as .glb, its sheet below `sheets` as .html if that
/// is not empty. @param keepExtension  chair.obj becomes chair.obj.glb. Errors: kUsage (two inputs with one output, an
/// output that is an input).
std::vector<BakeJob> jobsInto(const std::filesystem::path& folder, const std::filesystem::path& sheets,
                              const std::vector<InputFile>& inputs, bool keepExtension);

}  // namespace jalousie::bake
