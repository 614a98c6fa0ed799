// What kind of output a file is, by its contents.
#pragma once

#include <filesystem>
#include <string_view>

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

/// The extension of files of a kind, with its point; empty of kAny.
std::string_view extensionOf(OutputKind kind);

/// Whether the extension of a name belongs to files of another kind: ".png" of what will be a scene.
bool hasForeignExtension(const std::filesystem::path& file, OutputKind kind);

/// The kind of a file; kAny if it is none of the others or cannot be read.
OutputKind kindOfFile(const std::filesystem::path& file);

}  // namespace jalousie
