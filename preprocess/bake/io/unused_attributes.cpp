// Collects the texture coordinate sets that the textures of a material read, in core properties and extensions.
#include "bake/io/unused_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace jalousie::bake {
namespace {

constexpr int kMostSets = 1024;

/// What the materials of a primitive read.
struct Used {
  std::set<int> texCoords;
  bool tangents = false;
};

/// Extensions nest as deep as the reader allows; each object with an `index` is a texture.
void collect(const tinygltf::Value& value, const std::string& key, Used& used) {
  if (key.find("ormal") != std::string::npos || key.find("anisotropy") != std::string::npos) used.tangents = true;
  if (value.IsArray()) {
    for (std::size_t i = 0; i < value.ArrayLen(); ++i)
      collect(value.Get(static_cast<int>(i)), "", used);
  }
  if (!value.IsObject()) return;
  const tinygltf::Value& set = value.Get("texCoord");
  if (set.IsNumber()) {
    used.texCoords.insert(set.GetNumberAsInt());
  } else if (value.Get("index").IsNumber()) {
    used.texCoords.insert(0);
  }
  for (const std::string& name : value.Keys())
    collect(value.Get(name), name, used);
}

void collect(const tinygltf::ExtensionMap& extensions, Used& used) {
  for (const auto& [name, value] : extensions)
    collect(value, name, used);
}

template <class Texture>
void collectTexture(const Texture& texture, Used& used) {
  if (texture.index < 0) return;
  used.texCoords.insert(texture.texCoord);
  collect(texture.extensions, used);  // KHR_texture_transform may name another set
}

void collectMaterial(const tinygltf::Model& model, int index, Used& used) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.materials.size()) return;
  const tinygltf::Material& material = model.materials[static_cast<std::size_t>(index)];
  collectTexture(material.pbrMetallicRoughness.baseColorTexture, used);
  collectTexture(material.pbrMetallicRoughness.metallicRoughnessTexture, used);
  collectTexture(material.normalTexture, used);
  collectTexture(material.occlusionTexture, used);
  collectTexture(material.emissiveTexture, used);
  used.tangents = used.tangents || material.normalTexture.index >= 0;
  collect(material.pbrMetallicRoughness.extensions, used);
  collect(material.extensions, used);
}

/// The texture coordinate sets of a primitive that stay. They are numbered without gaps: those below one that is used
/// stay as well.
std::set<std::string> keptSets(const tinygltf::Primitive& primitive, const Used& used) {
  std::set<std::string> kept;
  std::set<std::string> below;
  for (int set = 0; !used.texCoords.empty() && set <= std::min(*used.texCoords.rbegin(), kMostSets); ++set) {
    const std::string name = fmt::format("TEXCOORD_{}", set);
    below.insert(name);
    if (used.texCoords.contains(set) && primitive.attributes.contains(name)) kept = below;
  }
  return kept;
}

/// Textures of features and properties (EXT_mesh_features, EXT_structural_metadata) belong to no material.
void collectPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Used& used) {
  collect(primitive.extensions, used);
  for (const char* name : {"EXT_structural_metadata", "EXT_feature_metadata"}) {
    const auto tables = model.extensions.find(name);
    if (primitive.extensions.contains(name) && tables != model.extensions.end()) collect(tables->second, name, used);
  }
}

std::vector<std::string> unusedOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto variants = primitive.extensions.find("KHR_materials_variants");
  if (primitive.material < 0) return {};
  Used used;
  collectMaterial(model, primitive.material, used);
  collectPrimitive(model, primitive, used);
  if (variants != primitive.extensions.end() && variants->second.IsObject()) {
    const tinygltf::Value& mappings = variants->second.Get("mappings");
    for (std::size_t i = 0; mappings.IsArray() && i < mappings.ArrayLen(); ++i) {
      const tinygltf::Value& mapping = mappings.Get(static_cast<int>(i));
      if (mapping.IsObject() && mapping.Get("material").IsNumber())
        collectMaterial(model, mapping.Get("material").GetNumberAsInt(), used);
    }
  }
  const std::set<std::string> kept = keptSets(primitive, used);
  std::vector<std::string> names;
  for (const auto& [name, accessor] : primitive.attributes)
    if (name == "TANGENT" ? !used.tangents : name.starts_with("TEXCOORD_") && !kept.contains(name))
      names.push_back(name);
  return names;
}

}  // namespace

std::vector<std::string> unusedAttributes(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  std::set<std::string> names;
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    for (const std::string& name : unusedOf(model, primitive))
      names.insert(name);
  return {names.begin(), names.end()};
}

tinygltf::Mesh withoutUnused(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  tinygltf::Mesh copy = mesh;
  for (tinygltf::Primitive& primitive : copy.primitives)
    for (const std::string& name : unusedOf(model, primitive))
      primitive.attributes.erase(name);
  return copy;
}

}  // namespace jalousie::bake
