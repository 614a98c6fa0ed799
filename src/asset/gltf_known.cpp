// Lists of names, and searches for numbers.
#include "asset/gltf_known.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "asset/mesh_occluders.h"
#include "asset/scene_rooms.h"

namespace jalousie::asset {
namespace {

/// Extensions whose references findReferences visits, or that refer to no accessor and no view.
constexpr std::array kKnown = {"AGI_articulations",
                               "EXT_feature_metadata",
                               "EXT_instance_features",
                               "EXT_lights_ies",
                               "EXT_lights_image_based",
                               "EXT_mesh_features",
                               "EXT_mesh_gpu_instancing",
                               "EXT_meshopt_compression",
                               "EXT_structural_metadata",
                               "EXT_texture_avif",
                               "EXT_texture_webp",
                               "KHR_animation_pointer",
                               "KHR_lights_punctual",
                               "KHR_mesh_quantization",
                               "KHR_meshopt_compression",
                               "KHR_node_hoverability",
                               "KHR_node_selectability",
                               "KHR_node_visibility",
                               "KHR_texture_basisu",
                               "KHR_texture_transform",
                               "KHR_xmp_json_ld",
                               "MSFT_lod",
                               "MSFT_packing_normalRoughnessMetallic",
                               "MSFT_packing_occlusionRoughnessMetallic",
                               "MSFT_texture_dds",
                               "VRM",
                               "VRMC_materials_mtoon",
                               "VRMC_node_constraint",
                               "VRMC_springBone",
                               "VRMC_vrm"};

/// Those of primitives that do not refer to vertices by their number.
constexpr std::array kOfPrimitives = {"EXT_feature_metadata", "EXT_mesh_features", "EXT_structural_metadata",
                                      "KHR_materials_variants"};

bool holdsInteger(const tinygltf::Value& value) {
  if (value.IsInt()) return true;
  if (value.IsArray()) {
    const auto& list = value.Get<tinygltf::Value::Array>();
    return std::any_of(list.begin(), list.end(), holdsInteger);
  }
  if (!value.IsObject()) return false;
  const auto& object = value.Get<tinygltf::Value::Object>();
  return std::any_of(object.begin(), object.end(), [](const auto& member) { return holdsInteger(member.second); });
}

}  // namespace

bool mayReferToVertices(std::string_view name, const tinygltf::Value& extension) {
  const bool known = std::find(kOfPrimitives.begin(), kOfPrimitives.end(), name) != kOfPrimitives.end();
  return !known && holdsInteger(extension);
}

namespace detail {

bool isKnownExtension(std::string_view name) {
  return name.starts_with("KHR_materials_") || std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
}

bool mayHoldReference(const nlohmann::json& value) {
  if (value.is_number_integer()) return true;
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    return text.find("/accessors/") != std::string::npos || text.find("/bufferViews/") != std::string::npos;
  }
  if (!value.is_structured()) return false;
  for (const auto& [key, member] : value.items())
    if (key != "jalousie" && key != kOccluders && key != kRooms && mayHoldReference(member)) return true;
  return false;
}

}  // namespace detail
}  // namespace jalousie::asset
