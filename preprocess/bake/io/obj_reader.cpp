// Parses with tinyobjloader, confines the MTL lookup and builds one mesh per material.
#include "bake/io/obj_reader.h"

#include <tiny_obj_loader.h>

#include <cmath>
#include <istream>
#include <map>
#include <sstream>
#include <streambuf>
#include <string_view>
#include <tuple>

#include "bake/io/obj_filter.h"
#include "core/confined_folder.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

constexpr std::uint64_t kMaxMaterialBytes = 16ULL << 20U;  ///< of all material files together
constexpr std::size_t kMaxMaterials = 10'000;              ///< the library spends two kilobytes on each

/// Passes the material files of a source to tinyobjloader.
class SourcedMaterials : public tinyobj::MaterialReader {
 public:
  explicit SourcedMaterials(const MaterialSource& source) : source_(source) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* indices, std::string* warning, std::string* error) override {
    const std::optional<std::vector<std::byte>> bytes = source_(name);
    if (!bytes) return false;
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    bytes_ += bytes->size();
    std::size_t count = materials->size();
    for (std::size_t at = text.find("newmtl"); at != std::string_view::npos; at = text.find("newmtl", at + 6))
      ++count;
    if (count > kMaxMaterials || bytes_ > kMaxMaterialBytes)
      throw Error(ErrorCode::kLimit, "the material files are too large");
    std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    tinyobj::LoadMtl(indices, materials, &stream, warning, error);
    return true;
  }

 private:
  const MaterialSource& source_;
  std::uint64_t bytes_ = 0;
};

float linearFromSrgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

/// Collects the triangles of one material and shares equal corners.
class PartBuilder {
 public:
  PartBuilder(const tinyobj::attrib_t& attributes, const std::filesystem::path& file)
      : attributes_(attributes), file_(file) {}

  void addCorner(const tinyobj::index_t& corner) {
    const auto key = std::tuple(corner.vertex_index, corner.normal_index, corner.texcoord_index);
    const auto [place, isNew] = vertices_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (isNew) addVertex(corner);
    mesh_.indices.push_back(place->second);
  }

  TriangleMesh finish() {
    if (!hasNormals_) mesh_.normals.clear();
    if (!hasUvs_) mesh_.uvs.clear();
    return std::move(mesh_);
  }

 private:
  void addVertex(const tinyobj::index_t& corner) {
    mesh_.positions.push_back(vec3At(attributes_.vertices, corner.vertex_index));
    hasNormals_ &= corner.normal_index >= 0;
    hasUvs_ &= corner.texcoord_index >= 0;
    glm::vec3 normal(0.0F, 1.0F, 0.0F);
    if (corner.normal_index >= 0) normal = vec3At(attributes_.normals, corner.normal_index);
    hasNormals_ &= glm::dot(normal, normal) > 1e-8F;
    mesh_.normals.push_back(glm::dot(normal, normal) > 1e-8F ? glm::normalize(normal) : glm::vec3(0.0F, 1.0F, 0.0F));
    glm::vec2 uv(0.0F);
    if (corner.texcoord_index >= 0) {
      const std::size_t at = checked(corner.texcoord_index, attributes_.texcoords.size(), 2);
      uv = {attributes_.texcoords[at], 1.0F - attributes_.texcoords[at + 1]};
    }
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) fail("a texture coordinate is NaN or infinite");
    mesh_.uvs.push_back(uv);
  }

  glm::vec3 vec3At(const std::vector<tinyobj::real_t>& values, int index) const {
    const std::size_t at = checked(index, values.size(), 3);
    const glm::vec3 result(values[at], values[at + 1], values[at + 2]);
    if (!std::isfinite(result.x) || !std::isfinite(result.y) || !std::isfinite(result.z))
      fail("a vertex holds NaN or an infinite number");
    return result;
  }

  std::size_t checked(int index, std::size_t size, std::size_t components) const {
    if (index < 0 || static_cast<std::size_t>(index) >= size / components) fail("a face has an index out of range");
    return static_cast<std::size_t>(index) * components;
  }

  [[noreturn]] void fail(const char* reason) const { throw Error(ErrorCode::kMalformed, reason, file_); }

  const tinyobj::attrib_t& attributes_;
  const std::filesystem::path& file_;
  TriangleMesh mesh_;
  std::map<std::tuple<int, int, int>, std::uint32_t> vertices_;
  bool hasNormals_ = true;
  bool hasUvs_ = true;
};

/// The triangles of each material by its index, -1 without material.
std::map<int, PartBuilder> collectParts(const tinyobj::attrib_t& attributes,
                                        const std::vector<tinyobj::shape_t>& shapes, std::size_t materials,
                                        const std::filesystem::path& file) {
  std::map<int, PartBuilder> parts;
  for (const tinyobj::shape_t& shape : shapes) {
    std::size_t first = 0;
    for (std::size_t f = 0; f < shape.mesh.num_face_vertices.size(); ++f) {
      const std::size_t corners = shape.mesh.num_face_vertices[f];
      if (first + corners > shape.mesh.indices.size()) throw Error(ErrorCode::kMalformed, "a face is incomplete", file);
      const int given = f < shape.mesh.material_ids.size() ? shape.mesh.material_ids[f] : -1;
      const int material = given >= 0 && static_cast<std::size_t>(given) < materials ? given : -1;
      PartBuilder& part = parts.try_emplace(material, attributes, file).first->second;
      for (std::size_t i = 2; i < corners; ++i)
        for (const std::size_t k : {std::size_t{0}, i - 1, i})
          part.addCorner(shape.mesh.indices[first + k]);
      first += corners;
    }
  }
  return parts;
}

/// A part without triangles, with name and colour of a material.
ObjPart partOf(const tinyobj::material_t& material) {
  ObjPart part;
  part.material = material.name;
  part.baseColor = {linearFromSrgb(glm::clamp(material.diffuse[0], 0.0F, 1.0F)),
                    linearFromSrgb(glm::clamp(material.diffuse[1], 0.0F, 1.0F)),
                    linearFromSrgb(glm::clamp(material.diffuse[2], 0.0F, 1.0F)),
                    glm::clamp(material.dissolve, 0.0F, 1.0F)};
  return part;
}

}  // namespace

std::vector<ObjPart> readObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                             const asset::ReadObserver& observer) {
  std::optional<ConfinedFolder> folder;
  const auto source = [&](const std::string& name) -> std::optional<std::vector<std::byte>> {
    if (!folder) folder.emplace(folderOf(file));
    std::optional<std::vector<std::byte>> content;
    try {
      content = folder->readFile(name, kMaxMaterialBytes);
    } catch (const Error&) {
      content.reset();  // reported as absent: the result changes once the file can be read
    }
    if (observer) observer(name, content ? std::optional<std::span<const std::byte>>(*content) : std::nullopt);
    return content;
  };
  return parseObj(bytes, file, source);
}

std::vector<ObjPart> parseObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                              const MaterialSource& materialSource) {
  std::istringstream stream(filteredObj(bytes, file));
  SourcedMaterials materialReader(materialSource);
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  // The library triangulates before indices are checked, so polygons are split here.
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, &materialReader,
                        /*triangulate=*/false))
    throw Error(ErrorCode::kMalformed, error.empty() ? "not a readable OBJ file" : error, file);

  std::vector<ObjPart> result;
  for (auto& [id, builder] : collectParts(attributes, shapes, materials.size(), file)) {
    ObjPart part = id < 0 ? ObjPart() : partOf(materials[static_cast<std::size_t>(id)]);
    part.mesh = builder.finish();
    if (!part.mesh.indices.empty()) result.push_back(std::move(part));
  }
  if (result.empty() && attributes.vertices.empty())
    throw Error(ErrorCode::kMalformed, "the OBJ file has no vertices", file);
  if (result.empty())
    throw Error(ErrorCode::kUnsupported, "the OBJ file has no faces; points and lines cannot be baked", file);
  return result;
}

}  // namespace jalousie::bake
