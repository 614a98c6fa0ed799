// Chooses the reader by the file's extension and builds glTF meshes from triangle lists.
#include "bake/io/import.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asset/accessor.h"
#include "asset/gltf_images.h"
#include "bake/io/obj_reader.h"
#include "bake/io/ply_reader.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/triangle_mesh.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

std::string lowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return extension;
}

tinygltf::Primitive makePrimitive(tinygltf::Model& model, TriangleMesh mesh, int material) {
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  if (mesh.normals.empty()) mesh.normals = smoothNormals(mesh.positions, mesh.indices);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, kTarget);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, kTarget);
  if (!mesh.uvs.empty()) primitive.attributes["TEXCOORD_0"] = asset::appendVec2(model, mesh.uvs, kTarget);
  if (!mesh.colors.empty()) primitive.attributes["COLOR_0"] = asset::appendVec4(model, mesh.colors, kTarget);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  return primitive;
}

/// JSON is UTF-8: invalid bytes in the names of files and materials become U+FFFD.
std::string utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

int appendMaterial(tinygltf::Model& model, const ObjPart& part) {
  if (part.material.empty()) return -1;
  tinygltf::Material material;
  material.name = utf8(part.material);
  material.pbrMetallicRoughness.baseColorFactor = {part.baseColor.r, part.baseColor.g, part.baseColor.b,
                                                   part.baseColor.a};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  if (part.baseColor.a < 1.0F) material.alphaMode = "BLEND";
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

void appendNode(tinygltf::Model& model, tinygltf::Mesh mesh) {
  tinygltf::Node node;
  node.name = mesh.name;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(mesh));
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(std::move(node));
}

tinygltf::Model emptyDocument() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  return model;
}

/// Adds a PLY or OBJ file as one node.
void appendFile(tinygltf::Model& model, std::span<const std::byte> bytes, const std::filesystem::path& file,
                const asset::ReadObserver& observer) {
  const std::string extension = lowerExtension(file);
  tinygltf::Mesh mesh;
  mesh.name = utf8(file.stem().string());
  if (extension == ".ply") {
    mesh.primitives.push_back(makePrimitive(model, readPly(bytes, file), -1));
  } else if (extension == ".obj") {
    for (ObjPart& part : readObj(bytes, file, observer)) {
      const int material = appendMaterial(model, part);
      mesh.primitives.push_back(makePrimitive(model, std::move(part.mesh), material));
    }
  } else {
    throw Error(ErrorCode::kUnsupported, "only .ply, .obj, .gltf and .glb files are read", file);
  }
  appendNode(model, std::move(mesh));
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
  return extension == ".ply" || extension == ".obj" || isGltf(file);
}

tinygltf::Model importBytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                            const asset::Limits& limits, const asset::ReadObserver& observer) {
  if (isGltf(file)) return parseWholeGltf(bytes, file, limits, observer);
  tinygltf::Model model = emptyDocument();
  appendFile(model, bytes, file, observer);
  return model;
}

tinygltf::Model importFiles(const std::vector<std::filesystem::path>& files, const asset::Limits& limits,
                            const ImportObserver& observer) {
  tinygltf::Model model = emptyDocument();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::filesystem::path& file = files[i];
    if (files.size() > 1 && isGltf(file))
      throw Error(ErrorCode::kUsage, "a glTF file is baked alone, not with other inputs", file);
    if (!isImportable(file))
      throw Error(ErrorCode::kUnsupported, "only .ply, .obj, .gltf and .glb files are read", file);
    const asset::ReadObserver observeInput = [&](const std::string& name,
                                                 std::optional<std::span<const std::byte>> bytes) {
      if (observer) observer(i, name, bytes);
    };
    const std::vector<std::byte> bytes = readFile(file, limits.maxFileBytes);
    observeInput({}, bytes);
    if (isGltf(file)) return parseWholeGltf(bytes, file, limits, observeInput);
    appendFile(model, bytes, file, observeInput);
  }
  return model;
}

}  // namespace jalousie::bake
