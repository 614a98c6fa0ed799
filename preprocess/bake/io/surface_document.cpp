// Each picture is read once, whatever number of materials shows it.
#include "bake/io/surface_document.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "asset/accessor.h"
#include "asset/image_io.h"
#include "bake/io/surface_objects.h"
#include "bake/mesh/normals.h"

namespace jalousie::bake {
namespace {

constexpr const char* kWebp = "EXT_texture_webp";

/// JSON is UTF-8: invalid bytes in the names of files and materials become U+FFFD.
std::string utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

bool leavesFolder(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
  return path.is_absolute() || (!path.empty() && *path.begin() == "..");
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

void declare(std::vector<std::string>& names, const char* name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
}

class Materials {
 public:
  Materials(tinygltf::Model& model, const PictureSource& pictures, Notes& notes)
      : model_(model), pictures_(pictures), notes_(notes) {}

  int append(const SurfaceMaterial& source) {
    tinygltf::Material material;
    material.name = utf8(source.name);
    tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = {source.baseColor.r, source.baseColor.g, source.baseColor.b, source.baseColor.a};
    pbr.metallicFactor = source.metallic;
    pbr.roughnessFactor = source.roughness;
    pbr.baseColorTexture.index = texture(source.baseColorPicture);
    material.normalTexture.index = texture(source.normalPicture);
    material.emissiveTexture.index = texture(source.emissivePicture);
    material.emissiveFactor = {source.emissive.r, source.emissive.g, source.emissive.b};
    if (material.emissiveTexture.index >= 0 && source.emissive == glm::vec3(0.0F))
      material.emissiveFactor = {1.0, 1.0, 1.0};
    if (source.baseColor.a < 1.0F || (source.alphaInPicture && pbr.baseColorTexture.index >= 0))
      material.alphaMode = "BLEND";
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

 private:
  /// @return  -1: none
  int texture(const std::string& name) {
    if (name.empty()) return -1;
    const auto [place, isNew] = textures_.try_emplace(name, -1);
    if (!isNew) return place->second;
    const std::optional<std::vector<std::byte>> bytes = pictures_(name);
    if (!bytes) {
      const bool leaves = leavesFolder(name);
      notes_.add(leaves ? "a picture lies outside of the input's folder" : "a picture is missing or cannot be read",
                 name);
      return -1;
    }
    const std::string mimeType(asset::imageMimeType(*bytes));
    if (mimeType.empty()) {
      notes_.add("a picture that is no PNG, JPEG or WebP is left out", name);
      return -1;
    }
    const bool isWebp = mimeType == "image/webp";
    if (const int equal = equalImage(*bytes); equal >= 0) return place->second = appendTexture(equal, isWebp);
    tinygltf::Image image;
    image.name = utf8(name);
    image.mimeType = mimeType;
    image.as_is = true;
    const auto* first = reinterpret_cast<const unsigned char*>(bytes->data());
    image.image.assign(first, first + bytes->size());
    const auto index = static_cast<int>(model_.images.size());
    model_.images.push_back(std::move(image));
    place->second = appendTexture(index, isWebp);
    return place->second;
  }

  /// An image with these bytes that the document has already; -1: none.
  int equalImage(const std::vector<std::byte>& bytes) const {
    for (std::size_t i = 0; i < model_.images.size(); ++i) {
      const std::vector<unsigned char>& known = model_.images[i].image;
      if (known.size() == bytes.size() && std::memcmp(known.data(), bytes.data(), bytes.size()) == 0)
        return static_cast<int>(i);
    }
    return -1;
  }

  int appendTexture(int image, bool isWebp) {
    tinygltf::Texture texture;
    if (isWebp) {
      texture.extensions[kWebp] = tinygltf::Value(tinygltf::Value::Object{{"source", tinygltf::Value(image)}});
      declare(model_.extensionsUsed, kWebp);
      declare(model_.extensionsRequired, kWebp);
    } else {
      texture.source = image;
    }
    model_.textures.push_back(std::move(texture));
    return static_cast<int>(model_.textures.size()) - 1;
  }

  tinygltf::Model& model_;
  const PictureSource& pictures_;
  Notes& notes_;
  std::map<std::string, int> textures_;
};

void appendNode(tinygltf::Model& model, tinygltf::Mesh mesh, const glm::dvec3& offset) {
  tinygltf::Node node;
  node.name = mesh.name;
  node.mesh = static_cast<int>(model.meshes.size());
  if (offset != glm::dvec3(0.0)) node.translation = {offset.x, offset.y, offset.z};
  model.meshes.push_back(std::move(mesh));
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(std::move(node));
}

}  // namespace

void appendSurface(tinygltf::Model& model, const PolygonMesh& mesh, const SurfaceSource& source, Notes& notes) {
  Materials materials(model, source.pictures, notes);
  std::map<int, int> indices = {{-1, -1}};
  for (SurfaceObject& object : buildObjects(mesh, source.rule)) {
    tinygltf::Mesh target;
    target.name = utf8(object.name.empty() ? source.name : object.name);
    for (SurfacePart& part : object.parts) {
      const auto [place, isNew] = indices.try_emplace(part.material, -1);
      if (isNew) place->second = materials.append(mesh.materials[static_cast<std::size_t>(part.material)]);
      target.primitives.push_back(makePrimitive(model, std::move(part.mesh), place->second));
    }
    appendNode(model, std::move(target), object.offset);
  }
}

}  // namespace jalousie::bake
