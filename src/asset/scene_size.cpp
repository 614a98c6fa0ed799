// One walk over the nodes that a scene shows, as scene_file.cpp takes it, and counts instead of elements.
#include "asset/scene_size.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "asset/gltf_images.h"
#include "asset/image_io.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "asset/lod_group.h"
#include "asset/mesh_pose.h"
#include "asset/node_graph.h"
#include "asset/scene_material.h"
#include "asset/scene_mesh.h"
#include "core/memory_estimate.h"
#include "shared/motion_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::asset {
namespace {

using detail::ShownMesh;
using detail::shownMesh;
using tinygltf::Model;

struct MeshSize {
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
};

/// Adds a * b, up to a number that no memory holds and that many sums cannot wrap.
void addProduct(std::uint64_t a, std::uint64_t b, std::uint64_t& sum) {
  constexpr std::uint64_t kMost = 1ULL << 48U;
  sum = std::min(sum + std::min(saturatingProduct(a, b), kMost), kMost);
}

class Counter {
 public:
  Counter(const Model& model, const Limits& limits) : model_(model), limits_(limits), groups_(model) {}

  SceneSize count() {
    for (const tinygltf::Buffer& buffer : model_.buffers)
      size_.documentBytes += buffer.data.size();
    for (const tinygltf::Image& image : model_.images)
      size_.documentBytes += image.image.size();
    countImages();
    std::vector<Visit> stack;
    for (const int root : sceneRoots(model_))
      stack.push_back({root, false});
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      countNode(visit);
      const bool isInGroup = visit.isInGroup || isLodGroup(model_, visit.node);
      for (const int child : model_.nodes[static_cast<std::size_t>(visit.node)].children)
        stack.push_back({child, isInGroup});
    }
    size_.cameraKeys = cameraKeys();
    countMotion();
    if (hasSecondUvs_) size_.secondUvs = size_.vertices;
    return std::move(size_);
  }

 private:
  std::uint64_t elements(int accessor) const { return model_.accessors[static_cast<std::size_t>(accessor)].count; }

  void countImages() {
    std::set<std::pair<int, bool>> known;
    for (const tinygltf::Material& material : model_.materials) {
      const detail::MaterialTextures textures = detail::texturesOf(model_, material);
      for (const auto& reference : {textures.base, textures.emission, textures.normals}) {
        if (!reference) continue;
        hasSecondUvs_ = hasSecondUvs_ || reference->use.uvSet == 1;
        if (!known.emplace(reference->image, reference->isData).second) continue;
        size_.images.push_back(
            detail::useImage(model_, static_cast<std::size_t>(reference->image),
                             [&](std::span<const std::byte> bytes) { return imageSize(bytes, limits_.images); }));
      }
    }
  }

  /// As in SceneReader.
  struct Visit {
    int node;
    bool isInGroup;
  };

  void countNode(const Visit& visit) {
    const int node = visit.node;
    const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
    if (source.camera >= 0) {
      ++size_.cameras;
      cameraNodes_.insert(node);
    }
    if (source.mesh >= 0) countLoose(node, model_.meshes[static_cast<std::size_t>(source.mesh)]);
    if (visit.isInGroup) return;
    if (isLodGroup(model_, node)) return countGroup(node);
    if (source.mesh < 0) return;
    countChain(node);
    const std::uint64_t instances = std::max<std::uint64_t>(countInstances(model_, node, limits_), 1);
    size_.instances += instances;
    const auto finest = meshes_.find(shownMesh(model_, node));
    size_.finestTriangles += saturatingProduct(instances, finest->second.indices / 3);
  }

  /// Each instance gets vertices of its own.
  void countLoose(int node, const tinygltf::Mesh& mesh) {
    if (!detail::hasLooseGeometry(mesh)) return;
    const std::uint64_t instances = std::max<std::uint64_t>(countInstances(model_, node, limits_), 1);
    addProduct(instances, 1, size_.looseInstances);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!detail::isLoose(primitive)) continue;
      const int accessor = primitive.indices >= 0 ? primitive.indices : primitive.attributes.at("POSITION");
      addProduct(instances, detail::looseVertexCount(primitive, elements(accessor)), size_.looseVertices);
    }
  }

  /// Chains of equal meshes are one.
  void countChain(int node) {
    ChainKey<ShownMesh> key;
    key.levels = {shownMesh(model_, node)};
    for (const int lower : lodNodes(model_, node))
      key.levels.push_back(shownMesh(model_, lower));
    key.coverage = lodThresholds(model_.nodes[static_cast<std::size_t>(node)], key.levels.size());
    std::vector<MeshSize> levels;
    for (const ShownMesh& mesh : key.levels)
      levels.push_back(countMesh(mesh));
    if (chains_.insert(std::move(key)).second) addChain(levels);
  }

  /// @param levels  of one chain, LOD 0 first
  void addChain(const std::vector<MeshSize>& levels) {
    ++size_.chains;
    const std::uint64_t finest = levels.front().indices / 3;
    size_.largestTriangles = std::max(size_.largestTriangles, finest);
    size_.levelTriangles += saturatingProduct(levels.size(), finest);
    size_.levels += levels.size();
    size_.coarsestVertices += levels.back().vertices;
    size_.coarsestIndices += levels.back().indices;
  }

  void countGroup(int node) {
    ChainKey<detail::GroupLevel> key;
    key.levels = groups_.levelsOf(node);
    key.coverage = lodThresholds(model_.nodes[static_cast<std::size_t>(node)], key.levels.size());
    std::vector<MeshSize> levels;
    for (const detail::GroupLevel& level : key.levels)
      levels.push_back(countLevel(level));
    ++size_.instances;
    size_.finestTriangles += levels.front().indices / 3;
    if (groupChains_.insert(std::move(key)).second) addChain(levels);
  }

  /// A level of a group is a mesh of its own that holds all its parts.
  MeshSize countLevel(const detail::GroupLevel& level) {
    const auto known = groupLevels_.find(level);
    if (known != groupLevels_.end()) return known->second;
    MeshSize size;
    const auto rest = [this](int node) { return localTransform(model_.nodes[static_cast<std::size_t>(node)]); };
    for (const detail::GroupPart& part : groups_.parts(level.content, rest)) {
      const MeshSize mesh = sizeOf(model_.meshes[static_cast<std::size_t>(part.mesh.mesh)]);
      const std::uint64_t copies = std::max<std::uint64_t>(countInstances(model_, part.node, limits_), 1);
      addProduct(copies, mesh.vertices, size.vertices);
      addProduct(copies, mesh.indices, size.indices);
    }
    groupLevels_.emplace(level, size);
    size_.vertices += size.vertices;
    size_.indices += size.indices;
    return size;
  }

  MeshSize countMesh(const ShownMesh& mesh) {
    const auto known = meshes_.find(mesh);
    if (known != meshes_.end()) return known->second;
    const tinygltf::Mesh& source = model_.meshes[static_cast<std::size_t>(mesh.mesh)];
    const MeshSize size = sizeOf(source);
    meshes_.emplace(mesh, size);
    size_.cellEnds += cellCount(lodCells(model_, source)) * source.primitives.size();
    for (const FaceTree& tree : lodFaces(model_, source).trees)
      size_.faceNumbers += tree.size();
    size_.vertices += size.vertices;
    size_.indices += size.indices;
    if (mesh.posedNode >= 0) countBending(source);
    return size;
  }

  MeshSize sizeOf(const tinygltf::Mesh& source) const {
    MeshSize size;
    for (const tinygltf::Primitive& primitive : source.primitives) {
      const MeshSize own = sizeOf(primitive);
      size.indices += own.indices;
      size.vertices += own.vertices;
    }
    return size;
  }

  MeshSize sizeOf(const tinygltf::Primitive& primitive) const {
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) return {};
    const std::uint64_t vertices = elements(position->second);
    std::uint64_t indices = primitive.indices >= 0 ? elements(primitive.indices) : vertices;
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) indices *= 3;  // strips and fans become triangles
    return {primitive.attributes.contains("NORMAL") ? vertices : std::max(vertices, indices), indices};
  }

  /// Keys of the channels that move cameras; channels that share their keys count once.
  std::uint64_t cameraKeys() const {
    std::set<std::tuple<int, int, std::string>> known;
    std::uint64_t keys = 0;
    for (const tinygltf::Animation& animation : model_.animations) {
      for (const tinygltf::AnimationChannel& channel : animation.channels) {
        if (!cameraNodes_.contains(channel.target_node)) continue;
        const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
        if (known.emplace(sampler.input, sampler.output, sampler.interpolation).second)
          keys += elements(sampler.output) * (sampler.interpolation == "STEP" ? 2 : 1);
      }
    }
    return keys;
  }

  /// Keys, nodes and joints, each once; bent vertices were counted with their meshes.
  void countMotion() {
    if (model_.animations.empty()) {
      size_.motionBytes = 0;
      return;
    }
    for (const tinygltf::Animation& animation : model_.animations)
      for (const tinygltf::AnimationSampler& sampler : animation.samplers)
        addProduct(elements(sampler.input) + 4 * elements(sampler.output), sizeof(float), size_.motionBytes);
    addProduct(model_.nodes.size(), sizeof(gpu::MotionNode), size_.motionBytes);
    addProduct(size_.instances + size_.looseInstances, sizeof(gpu::MotionTarget), size_.motionBytes);
    addProduct(size_.looseVertices, sizeof(gpu::BentVertex), size_.motionBytes);
    for (const tinygltf::Skin& skin : model_.skins)
      addProduct(skin.joints.size(), sizeof(gpu::MotionTarget) + sizeof(gpu::Transform), size_.motionBytes);
  }

  /// What plays a mesh that a skin or morph targets bend.
  void countBending(const tinygltf::Mesh& mesh) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const MeshSize size = sizeOf(primitive);
      std::uint64_t sets = 0;
      while (primitive.attributes.contains("JOINTS_" + std::to_string(sets)))
        ++sets;
      const std::uint64_t each = sizeof(gpu::BentVertex) + 4 * sets * sizeof(gpu::Influence) +
                                 primitive.targets.size() * sizeof(gpu::MorphDelta);
      addProduct(size.vertices, each, size_.motionBytes);
    }
  }

  const Model& model_;
  const Limits& limits_;
  SceneSize size_;
  bool hasSecondUvs_ = false;
  std::map<ShownMesh, MeshSize> meshes_;
  std::set<ChainKey<ShownMesh>> chains_;
  detail::LodGroups groups_;
  std::map<detail::GroupLevel, MeshSize> groupLevels_;
  std::set<ChainKey<detail::GroupLevel>> groupChains_;
  std::set<int> cameraNodes_;
};

}  // namespace

SceneSize measureScene(const Model& model, const Limits& limits) {
  return Counter(model, limits).count();
}

}  // namespace jalousie::asset
