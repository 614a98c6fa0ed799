// Reads any supported file into a glTF document.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "bake/io/notes.h"

namespace jalousie::bake {

/// Called for each file that is read, or sought in vain, on the way to a document. `input` is the index of the input it
/// belongs to; `name` is relative to that input's folder and empty for the input itself; bytes are absent if there is
/// no such file.
using ImportObserver =
    std::function<void(std::size_t input, const std::string& name, std::optional<std::span<const std::byte>> bytes)>;

/// Reads .ply, .obj, .stl, .gltf or .glb by the file's extension. A single glTF input is returned unchanged; of other
/// files each object becomes a mesh and a node, in the order given. Where normals are missing, PLY files get smooth
/// ones, OBJ and STL files smooth ones up to creases. @param notes  gets what is left out or missing. Errors: kUsage
/// (several inputs of which one is glTF), kUnsupported (another extension), and those of the readers.
tinygltf::Model importFiles(const std::vector<std::filesystem::path>& files, const asset::Limits& limits, Notes& notes,
                            const ImportObserver& observer = {});
/// As importFiles for a single file whose bytes are in memory already; other files are sought beside `file`.
tinygltf::Model importBytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                            const asset::Limits& limits, const asset::ReadObserver& observer = {});
/// Whether files of this name's extension are read.
bool isImportable(const std::filesystem::path& file);
/// Whether it is glTF, which cannot be joined with other inputs.
bool isGltf(const std::filesystem::path& file);

}  // namespace jalousie::bake
