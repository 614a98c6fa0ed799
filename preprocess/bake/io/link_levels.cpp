// Copies transforms, instances and animation channels from the node of LOD 0.
#include "bake/io/link_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "asset/lod_chain.h"

namespace jalousie::bake {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// Extensions that go with a node's mesh.
bool belongsToMesh(const std::string& extension) {
  return extension == kInstancing || extension == "EXT_instance_features";
}

/// Appends the node of one level: same transform, same instances, no children.
int appendLevelNode(tinygltf::Model& model, const tinygltf::Node& source, int mesh, std::size_t lod) {
  tinygltf::Node node;
  node.name = fmt::format("{}_lod{}", source.name, lod);
  node.mesh = mesh;
  node.translation = source.translation;
  node.rotation = source.rotation;
  node.scale = source.scale;
  node.matrix = source.matrix;
  for (const auto& extension : source.extensions)
    if (belongsToMesh(extension.first)) node.extensions.insert(extension);
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

/// Appends the node of a level that shows nothing.
int appendEmptyLevel(tinygltf::Model& model, const tinygltf::Node& source, std::size_t lod) {
  tinygltf::Node node;
  node.name = fmt::format("{}_lod{}", source.name, lod);
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

/// Copies every channel that moves the node of LOD 0 to the nodes of the levels.
void animateLevels(tinygltf::Model& model, const ChannelIndex& channels, int node, const std::vector<int>& levels) {
  const auto [first, last] = channels.byNode.equal_range(node);
  for (auto at = first; at != last; ++at) {
    std::vector<tinygltf::AnimationChannel>& list = model.animations[at->second.first].channels;
    for (const int level : levels) {
      tinygltf::AnimationChannel copy = list[at->second.second];
      copy.target_node = level;
      list.push_back(std::move(copy));
    }
  }
}

/// Readers replace the whole node when a level is shown. What else a node holds would vanish with its mesh: children,
/// cameras, lights and whatever extensions make of it. Extras that are no object have no place for the coverage.
bool holdsMoreThanItsMesh(const tinygltf::Node& node) {
  return !node.children.empty() || node.camera >= 0 ||
         (node.extras.Type() != tinygltf::NULL_TYPE && !node.extras.IsObject()) ||
         std::any_of(node.extensions.begin(), node.extensions.end(),
                     [](const auto& extension) { return !belongsToMesh(extension.first); });
}

/// The node in "/nodes/3/translation", which a channel of KHR_animation_pointer changes.
std::optional<int> pointedNode(const tinygltf::AnimationChannel& channel) {
  const auto extension = channel.target_extensions.find("KHR_animation_pointer");
  if (extension == channel.target_extensions.end() || !extension->second.IsObject()) return std::nullopt;
  const tinygltf::Value& pointer = extension->second.Get("pointer");
  constexpr std::string_view kNodes = "/nodes/";
  if (!pointer.IsString() || !pointer.Get<std::string>().starts_with(kNodes)) return std::nullopt;
  const std::string_view rest = std::string_view(pointer.Get<std::string>()).substr(kNodes.size());
  int node = -1;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), node);
  return status == std::errc() && node >= 0 ? std::optional(node) : std::nullopt;
}

/// Moves the mesh of a node, and its instances, into a new child. @return  the child
int moveMeshIntoChild(tinygltf::Model& model, int parent) {
  const auto index = static_cast<int>(model.nodes.size());
  tinygltf::Node& node = model.nodes[static_cast<std::size_t>(parent)];
  tinygltf::Node child;
  child.name = node.name;
  child.mesh = std::exchange(node.mesh, -1);
  for (auto at = node.extensions.begin(); at != node.extensions.end();) {
    if (!belongsToMesh(at->first)) {
      ++at;
      continue;
    }
    child.extensions.insert(*at);
    at = node.extensions.erase(at);
  }
  node.children.push_back(index);
  model.nodes.push_back(std::move(child));
  return index;
}

}  // namespace

ChannelIndex indexChannels(const tinygltf::Model& model) {
  ChannelIndex index;
  for (const tinygltf::Skin& skin : model.skins)
    index.joints.insert(skin.joints.begin(), skin.joints.end());
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    for (std::size_t c = 0; c < model.animations[a].channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = model.animations[a].channels[c];
      if (const std::optional<int> node = pointedNode(channel))
        index.pointed.insert(*node);
      else if (channel.target_path != "weights")
        index.byNode.emplace(channel.target_node, std::pair(a, c));
    }
  }
  return index;
}

void linkNodes(tinygltf::Model& model, const ChannelIndex& channels, const std::vector<int>& nodes,
               const std::vector<int>& levelMeshes, const std::vector<float>& coverage) {
  const bool endsInNothing = !coverage.empty() && coverage.back() > 0.0F;
  if (levelMeshes.size() < 2 && !endsInNothing) return;
  for (const int user : nodes) {
    const bool divide = channels.pointed.contains(user) || channels.joints.contains(user) ||
                        holdsMoreThanItsMesh(model.nodes[static_cast<std::size_t>(user)]);
    const int n = divide ? moveMeshIntoChild(model, user) : user;
    const tinygltf::Node source = model.nodes[static_cast<std::size_t>(n)];
    std::vector<int> lower;
    for (std::size_t k = 1; k < levelMeshes.size(); ++k)
      lower.push_back(appendLevelNode(model, source, levelMeshes[k], k));
    if (!divide) animateLevels(model, channels, n, lower);
    std::vector<float> thresholds = coverage;
    if (endsInNothing) {
      lower.push_back(appendEmptyLevel(model, source, levelMeshes.size()));
      thresholds.push_back(0.0F);
    }
    asset::setLodChain(model, n, lower, thresholds);
  }
}

}  // namespace jalousie::bake
