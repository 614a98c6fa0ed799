// What kind of output a file is, by its contents.
#pragma once

#include <filesystem>

namespace jalousie {

/// Kinds of files that the programs write.
enum class OutputKind {
  kAny,         ///< no other kind
  kPicture,     ///< PNG
  kReport,      ///< JSON, but no glTF
  kScene,       ///< glTF or GLB with meshes, or without cameras
  kCameraPath,  ///< glTF or GLB with cameras and without meshes
  kPage,        ///< HTML
  kRules,       ///< dependencies for make
};

/// "a PNG picture", for messages; "another kind of file" of kAny.
const char* nameOf(OutputKind kind);

/// The kind of a file; kAny if it is none of the others or cannot be read.
OutputKind kindOfFile(const std::filesystem::path& file);

}  // namespace jalousie
