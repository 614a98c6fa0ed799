// Looks up the materials that the statements name; MTL files are parsed by tinyobjloader.
#include "bake/io/obj_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "bake/io/beside.h"
#include "bake/io/color_space.h"
#include "bake/io/obj_statements.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

constexpr std::uint64_t kMaxMaterialBytes = 16ULL << 20U;  ///< of all material files together
constexpr std::size_t kMaxKeywords = 32;                   ///< that are named in a warning
constexpr std::size_t kMaxMaterials = 10'000;              ///< the library spends two kilobytes on each

/// The materials of MTL files by name; the first definition counts.
class MaterialLibrary {
 public:
  void read(std::span<const std::byte> bytes) {
    const std::string text(withoutByteOrderMark({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
    bytes_ += bytes.size();
    std::size_t count = materials_.size();
    for (std::size_t at = text.find("newmtl"); at != std::string::npos; at = text.find("newmtl", at + 6))
      ++count;
    if (count > kMaxMaterials || bytes_ > kMaxMaterialBytes)
      throw Error(ErrorCode::kLimit, "the material files are too large");
    std::istringstream stream(text);
    std::string warning;
    std::string error;
    tinyobj::LoadMtl(&indices_, &materials_, &stream, &warning, &error);
    std::vector<bool> hasDiffuse = readKeywords(text);
    hasDiffuse.resize(materials_.size() - known_);
    for (std::size_t i = known_; i < materials_.size(); ++i) {
      if (!hasDiffuse[i - known_]) std::fill_n(materials_[i].diffuse, 3, 1.0F);  // the library's default is black
      byName_.try_emplace(materials_[i].name, i);
    }
    known_ = materials_.size();
  }

  /// Keywords that have no counterpart, and of which nothing else is said.
  const std::set<std::string>& passedOver() const { return passedOver_; }

  const tinyobj::material_t* find(const std::string& name) const {
    const auto found = byName_.find(name);
    return found == byName_.end() ? nullptr : &materials_[found->second];
  }

 private:
  /// What the library does not tell: which materials have a diffuse colour, and statements that nobody reads.
  std::vector<bool> readKeywords(const std::string& text) {
    static const std::set<std::string> kRead = {"newmtl",   "Kd",       "d",      "Tr",     "Ke",     "Pm",
                                                "Pr",       "illum",    "map_Kd", "map_Ke", "norm",   "map_d",
                                                "map_bump", "map_Bump", "bump",   "disp",   "map_Ks", "map_Ns",
                                                "refl",     "map_refl", "map_Pr", "map_Pm", "map_Ka", "map_Ps"};
    std::vector<bool> hasDiffuse;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string keyword;
      if (!(words >> keyword) || keyword.starts_with('#')) continue;
      if (keyword == "newmtl") hasDiffuse.push_back(false);
      if (keyword == "Kd" && !hasDiffuse.empty()) hasDiffuse.back() = true;
      if (!kRead.contains(keyword) && passedOver_.size() < kMaxKeywords) passedOver_.insert(keyword.substr(0, 40));
    }
    return hasDiffuse;
  }

  std::set<std::string> passedOver_;
  std::map<std::string, int> indices_;
  std::vector<tinyobj::material_t> materials_;
  std::map<std::string, std::size_t> byName_;
  std::size_t known_ = 0;
  std::uint64_t bytes_ = 0;
};

glm::vec3 linearColor(const tinyobj::real_t (&color)[3]) {
  const auto channel = [&](int k) { return linearFromSrgb(std::clamp(color[k], 0.0F, 1.0F)); };
  return {channel(0), channel(1), channel(2)};
}

/// Exporters on Windows write the separators of their system.
std::string pictureName(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

void noteUnused(const tinyobj::material_t& material, Notes& notes) {
  const std::map<const char*, const std::string*> unused = {
      {"map_bump", &material.bump_texname},   {"disp", &material.displacement_texname},
      {"map_Ks", &material.specular_texname}, {"map_Ns", &material.specular_highlight_texname},
      {"refl", &material.reflection_texname}, {"map_Pr", &material.roughness_texname},
      {"map_Pm", &material.metallic_texname}, {"map_Ka", &material.ambient_texname},
      {"map_Ps", &material.sheen_texname}};
  for (const auto& [keyword, name] : unused)
    if (!name->empty()) notes.add(std::string(keyword) + " has no counterpart and is left out", *name);
  const tinyobj::texture_option_t& options = material.diffuse_texopt;
  const auto isPlain = [](const tinyobj::real_t(&values)[3], tinyobj::real_t usual) {
    return values[0] == usual && values[1] == usual && values[2] == usual;
  };
  if (!isPlain(options.scale, 1.0F) || !isPlain(options.origin_offset, 0.0F) || options.clamp)
    notes.add("scale, offset and clamping of a texture are left out", material.diffuse_texname);
  if (!material.alpha_texname.empty() && material.alpha_texname != material.diffuse_texname)
    notes.add("map_d with a picture of its own is left out", material.alpha_texname);
}

SurfaceMaterial surfaceOf(const tinyobj::material_t& material, Notes& notes) {
  SurfaceMaterial surface;
  surface.name = material.name;
  const auto& kd = material.diffuse;
  // The library sets 0.6 where a picture has no Kd beside it; exporters write black, which means white as well.
  const bool isUnset = kd[0] == kd[1] && kd[1] == kd[2] && (kd[0] == 0.0F || kd[0] == 0.6F);
  const bool onlyPicture = !material.diffuse_texname.empty() && isUnset;
  surface.baseColor = glm::vec4(onlyPicture ? glm::vec3(1.0F) : linearColor(kd), 1.0F);
  surface.baseColor.a = std::clamp(material.dissolve, 0.0F, 1.0F);
  surface.emissive = linearColor(material.emission);
  surface.baseColorPicture = pictureName(material.diffuse_texname);
  surface.emissivePicture = pictureName(material.emissive_texname);
  surface.normalPicture = pictureName(material.normal_texname);
  surface.alphaInPicture = !material.diffuse_texname.empty() && material.alpha_texname == material.diffuse_texname;
  surface.metallic = std::clamp(material.metallic, 0.0F, 1.0F);
  if (material.roughness > 0.0F) surface.roughness = std::clamp(material.roughness, 0.0F, 1.0F);
  noteUnused(material, notes);
  return surface;
}

/// Whether a name stands for several, as mtllib lines may hold names with spaces.
bool isKnownToBePart(const std::string& name, const std::set<std::string>& read) {
  return std::any_of(read.begin(), read.end(), [&](const std::string& whole) {
    return whole.find(' ') != std::string::npos && whole.find(name) != std::string::npos;
  });
}

}  // namespace

PolygonMesh readObj(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes,
                    const asset::ReadObserver& observer) {
  Beside beside(file, kMaxMaterialBytes, observer);
  return parseObj(
      bytes, file, [&](const std::string& name) { return beside.read(name); }, notes);
}

PolygonMesh parseObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                     const MaterialSource& materialSource, Notes& notes) {
  ObjStatements statements = readObjStatements(bytes, file, notes);
  PolygonMesh& mesh = statements.mesh;
  if (mesh.faces.empty() && mesh.positions.empty())
    throw Error(ErrorCode::kMalformed, "the OBJ file has no vertices", file);
  if (mesh.faces.empty())
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the OBJ file has no face of 3 to {} corners; points and lines cannot be baked",
                            kMaxPolygonCorners),
                file);

  MaterialLibrary library;
  std::set<std::string> sought;
  std::set<std::string> read;
  for (const std::string& name : statements.libraries) {
    if (!sought.insert(name).second) continue;
    const std::optional<std::vector<std::byte>> content = materialSource(name);
    if (content) library.read(*content);
    if (content) read.insert(name);
  }
  for (const std::string& name : sought) {
    const bool isWhole = name.find(' ') != std::string::npos;  // its words were sought as well
    if (!read.contains(name) && !isWhole && !isKnownToBePart(name, read))
      notes.add("a material file is missing or cannot be read", name);
  }
  if (!library.passedOver().empty())
    notes.add("MTL statements have no counterpart and are passed over",
              fmt::format("{}", fmt::join(library.passedOver(), ", ")));
  for (SurfaceMaterial& material : mesh.materials) {
    const tinyobj::material_t* found = library.find(material.name);
    if (found != nullptr) {
      material = surfaceOf(*found, notes);
    } else if (!read.empty()) {
      notes.add("a material is not defined in any material file", material.name);
    }
  }
  return std::move(statements.mesh);
}

}  // namespace jalousie::bake
