// Scan, parse and shape checks of glTF JSON.
#include "asset/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "asset/gltf_shapes.h"
#include "asset/mesh_occluders.h"
#include "asset/scene_rooms.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr std::uint64_t kMaxIndex = std::numeric_limits<int>::max();
constexpr std::uint64_t kMaxSize = 1ULL << 53U;  // integers a JSON number carries exactly

constexpr std::array kKnownExtensions = {
    "MSFT_lod", "EXT_mesh_gpu_instancing", "KHR_mesh_quantization", "KHR_texture_transform", "EXT_meshopt_compression",
    "EXT_texture_webp", "KHR_draco_mesh_compression", "KHR_meshopt_compression",
    // kept as they are; geometry can be read without them
    "EXT_instance_features", "EXT_mesh_features", "EXT_structural_metadata", "EXT_texture_avif",
    "KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_variants", "KHR_node_visibility",
    "KHR_texture_basisu", "KHR_xmp_json_ld", "MSFT_texture_dds",
    // of materials, which are kept as they are
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen", "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_volume"};
constexpr std::array kTopLevelArrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                        "images",    "materials",  "meshes",  "nodes",       "samplers",
                                        "scenes",    "skins",      "textures"};
constexpr std::array kIndexKeys = {
    "bufferView", "buffer", "mesh", "camera", "skin",   "material", "indices",  "source",
    "sampler",    "index",  "node", "input",  "output", "scene",    "skeleton", "inverseBindMatrices",
    "texCoord",   "mode"};
constexpr std::array kIndexMapKeys = {"attributes"};
constexpr std::array kIndexListKeys = {"nodes", "children", "joints", "ids"};
constexpr std::array kSizeKeys = {"byteLength", "byteOffset", "byteStride", "count", "componentType"};

template <class List>
bool contains(const List& list, std::string_view key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// Bounds nesting and the number of values; brackets and commas inside strings do not count.
void scan(std::string_view text, const Limits& limits, const Path& file) {
  std::uint64_t depth = 0;
  std::uint64_t elements = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      inString = c != '"';
      continue;
    }
    inString = c == '"';
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && depth > 0) --depth;
    if (c == ',') ++elements;
    if (depth > limits.maxJsonDepth)
      throw Error(ErrorCode::kLimit, fmt::format("JSON is nested deeper than {}", limits.maxJsonDepth), file);
    if (elements > limits.maxJsonElements)
      throw Error(ErrorCode::kLimit, fmt::format("JSON has more than {} elements", limits.maxJsonElements), file);
  }
}

std::uint64_t requireUnsigned(const json& value, const char* key, std::uint64_t limit, const Path& file) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > limit)
    throw Error(ErrorCode::kMalformed, fmt::format("\"{}\" is not a valid index or size", key), file);
  return value.get<std::uint64_t>();
}

void requireIndices(const json& values, const char* key, const Path& file) {
  for (const json& value : values) {
    if (!value.is_object()) requireUnsigned(value, key, kMaxIndex, file);
  }
}

/// Checks the members of one object that are indices or sizes by their name.
void checkMember(const std::string& key, const json& value, const Path& file) {
  if (contains(kIndexKeys, key) && !value.is_object()) requireUnsigned(value, key.c_str(), kMaxIndex, file);
  if (contains(kSizeKeys, key)) requireUnsigned(value, key.c_str(), kMaxSize, file);
  if (contains(kIndexListKeys, key) && value.is_array()) requireIndices(value, key.c_str(), file);
  if (contains(kIndexMapKeys, key) && value.is_object()) requireIndices(value, key.c_str(), file);
}

/// Walks everything but extras and the extensions of others. Recursion is bounded by the scan.
void checkNumbers(const json& value, const Path& file) {
  if (value.is_array()) {
    for (const json& element : value)
      checkNumbers(element, file);
  }
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (key == "extensions" && member.is_object()) {
      for (const char* known : {"MSFT_lod", "EXT_mesh_gpu_instancing", "EXT_texture_webp"}) {
        const auto extension = member.find(known);
        if (extension == member.end()) continue;
        if (!extension->is_object()) throw Error(ErrorCode::kMalformed, fmt::format("{} is no object", known), file);
        checkNumbers(*extension, file);
      }
      continue;
    }
    checkMember(key, member, file);
    checkNumbers(member, file);
  }
}

bool holdsLargeInteger(const json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>() > kMaxIndex;
  if (!value.is_structured()) return false;
  return std::any_of(value.begin(), value.end(), holdsLargeInteger);
}

/// Whether a value holds null, or a list or object without members.
bool holdsNothing(const json& value) {
  if (value.is_null()) return true;
  return value.is_structured() && (value.empty() || std::any_of(value.begin(), value.end(), holdsNothing));
}

/// tinygltf cuts integers to 32 bits: the counts in a baked mesh's extras would change without a word. It leaves out
/// what is empty, which no table of the baker has.
void checkOwnExtras(const json& document, const char* list, const char* owner, std::initializer_list<const char*> keys,
                    const Path& file) {
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array()) return;
  for (std::size_t i = 0; i < found->size(); ++i) {
    const json& element = (*found)[i];
    if (!element.is_object() || !element.contains("extras") || !element["extras"].is_object()) continue;
    for (const char* key : keys) {
      const auto own = element["extras"].find(key);
      if (own != element["extras"].end() && holdsLargeInteger(*own))
        throw Error(ErrorCode::kMalformed, fmt::format("{} {}: extras.{} holds a number above 2^31 - 1", owner, i, key),
                    file);
      if (own != element["extras"].end() && std::string_view(key) == "jalousie" && holdsNothing(*own))
        throw Error(ErrorCode::kMalformed,
                    fmt::format("{} {}: extras.{} holds null, or an empty list or object", owner, i, key), file);
    }
  }
}

void checkVersion(const json& document, const Path& file) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string())
    throw Error(ErrorCode::kMalformed, "no glTF document: asset.version is missing", file);
  const std::string version = (*asset)["version"].get<std::string>();
  if (!version.starts_with("2."))
    throw Error(ErrorCode::kUnsupported, fmt::format("glTF version \"{}\", only 2.0 is read", version), file);
  if (asset->contains("minVersion") && (*asset)["minVersion"] != "2.0")
    throw Error(ErrorCode::kUnsupported, "glTF minVersion above 2.0", file);
}

void checkExtensions(const json& document, const Path& file) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end()) return;
  if (!required->is_array()) throw Error(ErrorCode::kMalformed, "extensionsRequired is not an array", file);
  std::string unknown;
  for (const json& name : *required) {
    if (!name.is_string()) throw Error(ErrorCode::kMalformed, "extensionsRequired holds no names", file);
    const auto& text = name.get_ref<const std::string&>();
    if (contains(kKnownExtensions, text)) continue;
    unknown += (unknown.empty() ? "" : ", ") + text;
  }
  if (!unknown.empty())
    throw Error(ErrorCode::kUnsupported, fmt::format("the file requires extensions not known here: {}", unknown), file);
}

void checkTopLevel(const json& document, const Path& file) {
  for (const char* key : kTopLevelArrays) {
    const auto found = document.find(key);
    if (found == document.end()) continue;
    const bool objects = found->is_array() &&
                         std::all_of(found->begin(), found->end(), [](const json& entry) { return entry.is_object(); });
    if (!objects) throw Error(ErrorCode::kMalformed, fmt::format("\"{}\" is not an array of objects", key), file);
  }
}

}  // namespace

json parseDocument(std::string_view text, const Limits& limits, const Path& file) {
  // A zero byte ends the text for the parser; padding may follow it, and nothing else.
  const std::size_t end = std::min(text.find('\0'), text.size());
  if (text.find_first_not_of('\0', end) != std::string_view::npos)
    throw Error(ErrorCode::kMalformed, "the JSON has something behind a zero byte", file);
  text = text.substr(0, end);
  scan(text, limits, file);
  json document;
  try {
    document = json::parse(text);
  } catch (const json::exception& error) {
    throw Error(ErrorCode::kMalformed, fmt::format("JSON: {}", error.what()), file);
  }
  if (!document.is_object()) throw Error(ErrorCode::kMalformed, "the JSON is not an object", file);
  checkVersion(document, file);
  checkExtensions(document, file);
  checkTopLevel(document, file);
  checkNumbers(document, file);
  checkOwnExtras(document, "meshes", "mesh", {"jalousie", kOccluders}, file);
  checkOwnExtras(document, "scenes", "scene", {kRooms}, file);
  checkShapes(document, file);
  return document;
}

void forgetExtension(json& document, std::string_view name) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = document.find(key);
    if (found == document.end() || !found->is_array()) continue;
    found->erase(std::remove(found->begin(), found->end(), json(name)), found->end());
    if (found->empty()) document.erase(key);
  }
}

std::uint64_t unsignedMember(const json& object, const char* key, std::uint64_t fallback, const Path& file) {
  const auto found = object.find(key);
  return found == object.end() ? fallback : requireUnsigned(*found, key, kMaxSize, file);
}

}  // namespace jalousie::asset::detail
