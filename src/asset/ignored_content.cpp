// Walks over materials, meshes, nodes, cameras and animations once.
#include "asset/ignored_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "asset/scene_material.h"

namespace jalousie::asset {
namespace {

/// Extensions that are drawn, or that say nothing about what is drawn.
constexpr std::array kDrawn = {"EXT_mesh_gpu_instancing",   "EXT_meshopt_compression",
                               "EXT_texture_webp",          "KHR_materials_emissive_strength",
                               "KHR_materials_unlit",       "KHR_mesh_quantization",
                               "KHR_meshopt_compression",   "KHR_texture_transform",
                               "KHR_xmp_json_ld",           "MSFT_lod",
                               "KHR_draco_mesh_compression"};

class Counter {
 public:
  Counter(const tinygltf::Model& model, bool isTimed)
      : model_(model),
        isTimed_(isTimed),
        parents_(parentsOf(model)),
        carriesCamera_(model.nodes.size(), false),
        isAboveCamera_(model.nodes.size(), false),
        carriesMesh_(model.nodes.size(), false) {
    findCarriers();
  }

  ContentCounts count() {
    for (const tinygltf::Material& material : model_.materials)
      countMaterial(material);
    for (const tinygltf::Texture& texture : model_.textures)
      countExtensions(texture.extensions);
    for (const tinygltf::Image& image : model_.images)
      countIf(image.image.empty(), "missing pictures");
    for (const tinygltf::Mesh& mesh : model_.meshes)
      countMesh(mesh);
    for (const tinygltf::Node& node : model_.nodes)
      countNode(node);
    countNestedLevels();
    for (const tinygltf::Animation& animation : model_.animations)
      countAnimation(animation);
    for (const std::string& name : model_.extensionsUsed)  // those of the document alone
      if (!isDrawn(name) && !seen_.contains(name)) ++counts_[shortName(name)];
    return std::move(counts_);
  }

 private:
  static bool isDrawn(std::string_view name) { return std::find(kDrawn.begin(), kDrawn.end(), name) != kDrawn.end(); }

  /// "clearcoat" of KHR_materials_clearcoat, "lights" of KHR_lights_punctual; else the whole name.
  static std::string shortName(const std::string& name) {
    constexpr std::string_view kMaterials = "KHR_materials_";
    if (name.starts_with(kMaterials)) return name.substr(kMaterials.size());
    return name == "KHR_lights_punctual" ? "lights" : name;
  }

  void countExtensions(const tinygltf::ExtensionMap& extensions) {
    for (const auto& [name, value] : extensions) {
      seen_.insert(name);
      if (!isDrawn(name)) ++counts_[shortName(name)];
    }
  }

  void countIf(bool condition, const char* name) {
    if (condition) ++counts_[name];
  }

  void countMaterial(const tinygltf::Material& material) {
    countExtensions(material.extensions);
    const detail::MaterialTextures drawn = detail::texturesOf(model_, material);
    countIf(material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0, "textures of metalness and roughness");
    countIf(material.occlusionTexture.index >= 0, "textures of occlusion");
    countIf(material.pbrMetallicRoughness.baseColorTexture.index >= 0 && !drawn.base, "textures of base colour");
    if (material.extensions.contains("KHR_materials_unlit")) return;
    countIf(material.normalTexture.index >= 0 && !drawn.normals, "textures of normals");
  }

  void countMesh(const tinygltf::Mesh& mesh) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      countExtensions(primitive.extensions);
    }
    countExtensions(mesh.extensions);
  }

  void countNode(const tinygltf::Node& node) { countExtensions(node.extensions); }

  /// Nodes with levels below a group with levels, or below a level of one: they are shown at LOD 0.
  void countNestedLevels() {
    std::vector<int> stack;
    const auto addChildren = [&](int node) {
      const std::vector<int>& children = model_.nodes[static_cast<std::size_t>(node)].children;
      stack.insert(stack.end(), children.begin(), children.end());
    };
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      const int node = static_cast<int>(n);
      if (!isLodGroup(model_, node)) continue;
      addChildren(node);
      for (const int level : lodIds(model_, node))
        addChildren(level);
    }
    std::vector<bool> isKnown(model_.nodes.size(), false);
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      if (isKnown[static_cast<std::size_t>(node)]) continue;
      isKnown[static_cast<std::size_t>(node)] = true;
      countIf(!lodIds(model_, node).empty(), "levels inside of groups with levels");
      addChildren(node);
    }
  }

  /// Channels that move something else than a camera.
  void countAnimation(const tinygltf::Animation& animation) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node < 0) continue;  // counted as KHR_animation_pointer
      const bool isFirst = channels_.emplace(channel.target_node, channel.target_path).second;
      if (isTimed_)
        countIf(!isFirst, "further animations of a property");
      else
        countIf(!movesCamerasAlone(channel), "animation channels");
    }
  }

  /// The scale of a camera's own node moves nothing; that of a node above it does.
  bool movesCamerasAlone(const tinygltf::AnimationChannel& channel) const {
    const auto node = static_cast<std::size_t>(channel.target_node);
    const bool isRigid = channel.target_path == "translation" || channel.target_path == "rotation";
    const bool moves = isRigid ? carriesCamera_[node] : channel.target_path == "scale" && isAboveCamera_[node];
    return moves && !carriesMesh_[node];
  }

  /// Marks a node and all nodes above it.
  void markUpwards(int node, std::vector<bool>& marks) const {
    for (; node >= 0 && !marks[static_cast<std::size_t>(node)]; node = parents_[static_cast<std::size_t>(node)])
      marks[static_cast<std::size_t>(node)] = true;
  }

  /// What the channels of a node move: cameras and meshes, which joints move as well.
  void findCarriers() {
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      const tinygltf::Node& node = model_.nodes[n];
      if (node.mesh >= 0) markUpwards(static_cast<int>(n), carriesMesh_);
      if (node.camera < 0) continue;
      markUpwards(static_cast<int>(n), carriesCamera_);
      markUpwards(parents_[n], isAboveCamera_);
    }
    for (const tinygltf::Skin& skin : model_.skins)
      for (const int joint : skin.joints)
        markUpwards(joint, carriesMesh_);
  }

  const tinygltf::Model& model_;
  bool isTimed_;
  std::vector<int> parents_;                        ///< of each node; -1: none
  std::vector<bool> carriesCamera_;                 ///< the node or one below it is a camera
  std::vector<bool> isAboveCamera_;                 ///< one below it is
  std::vector<bool> carriesMesh_;                   ///< the node or one below it shows a mesh or is a joint
  std::set<std::pair<int, std::string>> channels_;  ///< nodes and properties that were moved already
  ContentCounts counts_;
  std::set<std::string> seen_;
};

}  // namespace

ContentCounts ignoredContent(const tinygltf::Model& model, bool isTimed) {
  return Counter(model, isTimed).count();
}

std::string toText(const ContentCounts& counts) {
  std::string text;
  for (const auto& [name, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text;
}

}  // namespace jalousie::asset
