// One function for each kind of object.
#include "asset/gltf_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;

class ShapeCheck {
 public:
  ShapeCheck(const json& document, const std::filesystem::path& file) : document_(document), file_(file) {}

  void run() {
    each("scenes", [&](const json& scene) { optionalList(scene, "nodes"); });
    each("nodes", [&](const json& node) { checkNode(node); });
    each("meshes", [&](const json& mesh) { checkMesh(mesh); });
    each("skins", [&](const json& skin) { requiredList(skin, "joints"); });
    each("animations", [&](const json& animation) { checkAnimation(animation); });
    each("materials", [&](const json& material) { checkMaterial(material); });
    each("textures", [&](const json& texture) { checkTexture(texture); });
    each("accessors", [&](const json& accessor) { checkSparse(accessor); });
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::kMalformed, fmt::format("{} {}: {}", kind_, index_, what), file_);
  }

  template <class Check>
  void each(const char* kind, const Check& check) {
    const auto list = document_.find(kind);
    if (list == document_.end()) return;
    kind_ = kind;
    index_ = 0;
    for (const json& entry : *list) {
      check(entry);
      ++index_;
    }
  }

  void optionalList(const json& object, const char* key) const {
    if (const auto found = object.find(key); found != object.end() && !found->is_array())
      fail(fmt::format("\"{}\" is not an array", key));
  }

  const json& requiredList(const json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array() || found->empty())
      fail(fmt::format("\"{}\" is missing, empty or not a list", key));
    return *found;
  }

  const json& requiredObject(const json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_object()) fail(fmt::format("\"{}\" is missing", key));
    return *found;
  }

  void required(const json& object, const char* key) const {
    if (!object.is_object() || !object.contains(key)) fail(fmt::format("\"{}\" is missing", key));
  }

  void numbers(const json& object, const char* key, std::size_t count) const {
    const auto found = object.find(key);
    if (found == object.end()) return;
    const bool fits = found->is_array() && found->size() == count &&
                      std::all_of(found->begin(), found->end(), [](const json& value) { return value.is_number(); });
    if (!fits) fail(fmt::format("\"{}\" is not a list of {} numbers", key, count));
  }

  /// A member of an extension; null if the object does not have it.
  static const json* extensionMember(const json& object, const char* extension, const char* key) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return nullptr;
    const auto found = extensions->find(extension);
    if (found == extensions->end() || !found->is_object()) return nullptr;
    const auto member = found->find(key);
    return member == found->end() ? nullptr : &*member;
  }

  std::size_t countOf(const char* kind) const {
    const auto list = document_.find(kind);
    return list == document_.end() ? 0 : list->size();
  }

  /// An index that an extension holds; absent ones pass.
  void indexBelow(const json* value, std::size_t count, const char* extension) const {
    if (value == nullptr) return;
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() >= count)
      fail(fmt::format("{}: index {} is out of range, there are {}", extension, oneLine(value->dump()), count));
  }

  void indicesBelow(const json* values, std::size_t count, const char* extension) const {
    if (values == nullptr) return;
    if (!values->is_array()) fail(fmt::format("{}: the indices are no list", extension));
    for (const json& value : *values)
      indexBelow(&value, count, extension);
  }

  void checkTexture(const json& texture) const {
    for (const char* extension : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"})
      indexBelow(extensionMember(texture, extension, "source"), countOf("images"), extension);
  }

  void checkVariants(const json& primitive) const {
    constexpr const char* kVariants = "KHR_materials_variants";
    const json* mappings = extensionMember(primitive, kVariants, "mappings");
    if (mappings == nullptr) return;
    const json* variants = extensionMember(document_, kVariants, "variants");
    if (!mappings->is_array()) fail(fmt::format("{}: the mappings are no list", kVariants));
    for (const json& mapping : *mappings) {
      if (!mapping.is_object()) fail(fmt::format("{}: a mapping is not an object", kVariants));
      const auto material = mapping.find("material");
      const auto names = mapping.find("variants");
      if (material != mapping.end()) indexBelow(&*material, countOf("materials"), kVariants);
      if (names != mapping.end()) indicesBelow(&*names, variants == nullptr ? 0 : variants->size(), kVariants);
    }
  }

  void checkNode(const json& node) const {
    const json* lights = extensionMember(document_, "KHR_lights_punctual", "lights");
    indexBelow(extensionMember(node, "KHR_lights_punctual", "light"), lights == nullptr ? 0 : lights->size(),
               "KHR_lights_punctual");
    optionalList(node, "children");
    numbers(node, "matrix", 16);
    numbers(node, "translation", 3);
    numbers(node, "rotation", 4);
    numbers(node, "scale", 3);
  }

  void checkMesh(const json& mesh) const {
    for (const json& primitive : requiredList(mesh, "primitives")) {
      if (!primitive.is_object()) fail("a primitive is not an object");
      if (requiredObject(primitive, "attributes").empty()) fail("a primitive has no attributes");
      optionalList(primitive, "targets");
      checkVariants(primitive);
    }
  }

  void checkAnimation(const json& animation) const {
    for (const json& sampler : requiredList(animation, "samplers")) {
      required(sampler, "input");
      required(sampler, "output");
    }
    for (const json& channel : requiredList(animation, "channels")) {
      required(channel, "sampler");
      requiredObject(channel, "target");
    }
  }

  void checkMaterial(const json& material) const {
    numbers(material, "emissiveFactor", 3);
    indicesBelow(extensionMember(material, "MSFT_lod", "ids"), countOf("materials"), "MSFT_lod");
    if (const auto found = material.find("pbrMetallicRoughness"); found != material.end()) {
      if (!found->is_object()) fail("\"pbrMetallicRoughness\" is not an object");
      numbers(*found, "baseColorFactor", 4);
    }
    checkTextures(material);
  }

  /// Every member named ...Texture, extensions included, refers to a texture. Recursion is bounded by the scan.
  void checkTextures(const json& value) const {
    for (const auto& [key, member] : value.items()) {
      if (key == "extras") continue;
      if (key.ends_with("Texture") && member.is_object()) {
        const auto index = member.find("index");
        if (index == member.end() || !index->is_number_unsigned()) fail(fmt::format("\"{}\" has no index", key));
        const std::size_t count = countOf("textures");
        if (index->get<std::uint64_t>() >= count)
          fail(fmt::format("\"{}\" is texture {}, there are {}", key, index->get<std::uint64_t>(), count));
      }
      if (member.is_structured()) checkTextures(member);
    }
  }

  /// tinygltf holds these in 32 bits with a sign.
  void checkSparse(const json& accessor) const {
    const auto sparse = accessor.find("sparse");
    if (sparse == accessor.end()) return;
    if (!sparse->is_object()) fail("\"sparse\" is not an object");
    small(*sparse, "count");
    for (const char* part : {"indices", "values"}) {
      const json& half = requiredObject(*sparse, part);
      required(half, "bufferView");
      small(half, "byteOffset");
    }
  }

  void small(const json& object, const char* key) const {
    const auto found = object.find(key);
    if (found != object.end() && found->is_number_unsigned() && found->get<std::uint64_t>() > 0x7FFFFFFFULL)
      fail(fmt::format("\"{}\" is out of range", key));
  }

  const json& document_;
  const std::filesystem::path& file_;
  const char* kind_ = "";
  std::size_t index_ = 0;
};

}  // namespace

void checkShapes(const json& document, const std::filesystem::path& file) {
  ShapeCheck(document, file).run();
}

}  // namespace jalousie::asset::detail
