// Chooses the reader by the file's extension.
#include "bake/io/import.h"
#include "bake/io/beside.h"

#include <algorithm>

#include "asset/gltf_images.h"
#include "bake/io/obj_reader.h"
#include "bake/io/ply_reader.h"
#include "bake/io/stl_reader.h"
#include "bake/io/surface_document.h"
#include "core/confined_folder.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

/// What a reader of files needs beside the bytes.
struct Surroundings {
  const asset::Limits& limits;
  const asset::ReadObserver& observer;
  Notes& notes;
};

std::string lowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return extension;
}

tinygltf::Model emptyDocument() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  return model;
}

constexpr const char* kKinds = "only .ply, .obj, .stl, .gltf and .glb files are read";

/// Adds a PLY, OBJ or STL file, a node for each of its objects.
void appendFile(tinygltf::Model& model, std::span<const std::byte> bytes, const std::filesystem::path& file,
                const Surroundings& around) {
  const std::string extension = lowerExtension(file);
  Notes& notes = around.notes;
  PolygonMesh mesh;
  if (extension == ".ply") {
    mesh = readPly(bytes, file, notes);
  } else if (extension == ".obj") {
    mesh = readObj(bytes, file, notes, around.observer);
  } else if (extension == ".stl") {
    mesh = readStl(bytes, file, notes);
  } else {
    throw Error(ErrorCode::kUnsupported, kKinds, file);
  }
  // PLY files are mostly scans, whose noise would be full of creases.
  const NormalRule rule = extension == ".ply" ? NormalRule::kNone : NormalRule::kCreases;
  Beside beside(file, around.limits.maxFileBytes, around.observer);
  const auto pictures = [&](const std::string& name) { return beside.read(name); };
  appendSurface(model, mesh, {file.stem().string(), rule, pictures}, notes);
}

/// The baker passes pictures on, so they must be whole.
tinygltf::Model parseWholeGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
                               const asset::Limits& limits, const asset::ReadObserver& observer) {
  tinygltf::Model model = asset::parseGltf(bytes, file, limits, observer, asset::Retain::kDocument);
  asset::checkImages(model, file, limits);
  return model;
}

}  // namespace

bool isGltf(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  return extension == ".gltf" || extension == ".glb";
}

bool isImportable(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  return extension == ".ply" || extension == ".obj" || extension == ".stl" || isGltf(file);
}

tinygltf::Model importBytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                            const asset::Limits& limits, const asset::ReadObserver& observer) {
  if (isGltf(file)) return parseWholeGltf(bytes, file, limits, observer);
  tinygltf::Model model = emptyDocument();
  Notes notes;
  appendFile(model, bytes, file, {limits, observer, notes});
  return model;
}

tinygltf::Model importFiles(const std::vector<std::filesystem::path>& files, const asset::Limits& limits, Notes& notes,
                            const ImportObserver& observer) {
  tinygltf::Model model = emptyDocument();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::filesystem::path& file = files[i];
    if (files.size() > 1 && isGltf(file))
      throw Error(ErrorCode::kUsage, "a glTF file is baked alone, not with other inputs", file);
    if (!isImportable(file)) throw Error(ErrorCode::kUnsupported, kKinds, file);
    const asset::ReadObserver observeInput = [&](const std::string& name,
                                                 std::optional<std::span<const std::byte>> bytes) {
      if (observer) observer(i, name, bytes);
    };
    const std::vector<std::byte> bytes = readFile(file, limits.maxFileBytes);
    observeInput({}, bytes);
    if (isGltf(file)) return parseWholeGltf(bytes, file, limits, observeInput);
    appendFile(model, bytes, file, {limits, observeInput, notes});
  }
  return model;
}

}  // namespace jalousie::bake
