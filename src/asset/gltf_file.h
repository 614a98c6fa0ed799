// Loads and saves glTF 2.0 documents. This unit wraps tinygltf: it turns bool and string results into Error, and it
// checks size, nesting and paths before tinygltf reads a byte.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asset/read_limits.h"

namespace jalousie::asset {

/// What a model holds of its document.
enum class Retain {
  kContent,   ///< what tinygltf understands
  kDocument,  ///< everything: its JSON as well, in Model::extensions_json_string
};

/// Loads a .gltf or .glb file with all its buffers. Images stay encoded: `image.image` holds the PNG, JPEG or WebP
/// bytes of the file, URI or buffer view, and `image.as_is` is true; formats and sizes are checked (checkImages does
/// the rest); KTX2, AVIF and DDS are not looked at. A picture whose file does not exist has no bytes, and checkImages
/// refuses it. External files are opened only inside the document's folder. The document is validated: every index that
/// one object holds of another is in range, every buffer view lies in its buffer, every accessor in its view, vertex
/// indices are below the vertex count, the node hierarchy is a forest. Views with EXT_meshopt_compression or
/// KHR_meshopt_compression and primitives with KHR_draco_mesh_compression are decoded, and the extension is gone.
/// Errors: kFileNotFound, kFileUnreadable, kMalformed, kUnsupported (unknown required extension), kLimit.
tinygltf::Model loadGltf(const std::filesystem::path& path, const Limits& limits = {},
                         const ReadObserver& observer = {});
/// As loadGltf, for a document that is in memory already. @param path  the document's file: for messages, and its
/// folder is where external files are searched
/// @param retain  kDocument: the model carries its JSON, and encodeGlb writes that JSON with the changes made since
tinygltf::Model parseGltf(std::span<const std::byte> bytes, const std::filesystem::path& path,
                          const Limits& limits = {}, const ReadObserver& observer = {},
                          Retain retain = Retain::kContent);

struct EncodeOptions {
  bool compress = false;  ///< vertex attributes and triangle indices as EXT_meshopt_compression, then required
};

/// Serialises a model as one binary glTF (GLB 2.0): one buffer, images embedded through buffer views. Same model, same
/// bytes. If the model carries its document (Retain::kDocument), everything in it that was not changed is written as it
/// was; elements may have been appended and changed since, not removed. Accessors and buffer views that nothing refers
/// to are dropped, and the order of the rest is kept. They are not renumbered if extras hold integers, and they all
/// stay if an extension that is not known here may refer to them.
std::vector<std::byte> encodeGlb(tinygltf::Model model, const EncodeOptions& options = {});

/// encodeGlb and core's writeFileAtomic. Errors: kWriteFailed.
void saveGlb(const tinygltf::Model& model, const std::filesystem::path& path, const EncodeOptions& options = {});

}  // namespace jalousie::asset
