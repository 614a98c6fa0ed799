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

namespace jalousie::bake {

/// Called for each file that is read, or sought in vain, on the way to a document. `input` is the index of the input it
/// belongs to; `name` is relative to that input's folder and empty for the input itself; bytes are absent if there is
/// no such file.
using ImportObserver =
    std::function<void(std::size_t input, const std::string& name, std::optional<std::span<const std::byte>> bytes)>;

/// Reads .ply, .obj, .gltf or .glb by the file's extension. A single glTF input is returned unchanged; PLY and OBJ
/// files become one mesh and node each, in the order given, with smooth normals where the file has none. Errors: kUsage
/// (several inputs of which one is glTF), kUnsupported (another extension), and those of the readers.
tinygltf::Model importFiles(const std::vector<std::filesystem::path>& files, const asset::Limits& limits,
                            const ImportObserver& observer = {});
/// As importFiles for a single file whose bytes are in memory already; other files are sought beside `file`.
tinygltf::Model importBytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                            const asset::Limits& limits, const asset::ReadObserver& observer = {});
/// Whether files of this name's extension are read.
bool isImportable(const std::filesystem::path& file);
/// Whether it is glTF, which cannot be joined with other inputs.
bool isGltf(const std::filesystem::path& file);

}  // namespace jalousie::bake
