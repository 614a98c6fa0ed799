// Flattening of a glTF document: one pass over the node hierarchy, meshes and chains made where they are first used.
#include "asset/scene_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "asset/gltf_file.h"
#include "asset/gltf_images.h"
#include "asset/ignored_content.h"
#include "asset/image_io.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/lod_group.h"
#include "asset/mesh_occluders.h"
#include "asset/motion_reader.h"
#include "asset/node_graph.h"
#include "asset/scene_camera.h"
#include "asset/scene_group.h"
#include "asset/scene_material.h"
#include "asset/scene_mesh.h"
#include "asset/scene_origin.h"
#include "asset/scene_pose.h"
#include "asset/scene_rooms.h"
#include "core/error.h"
#include "core/memory_estimate.h"

namespace jalousie::asset {
namespace {

using detail::ShownMesh;
using detail::shownMesh;
using tinygltf::Model;

/// Primitives may share their accessors, and each is read for itself: what they may ask for follows the file's size.
std::uint64_t demandLimit(const Model& model, const Limits& limits) {
  std::uint64_t elements = 1ULL << 24U;
  for (const tinygltf::Buffer& buffer : model.buffers)
    elements += 64 * std::uint64_t{buffer.data.size()};
  return std::min(elements, limits.maxAccessorElements);
}

/// A node still to be visited.
struct Visit {
  int node;
  glm::dmat4 worldFromParent;
  bool isInGroup = false;  ///< the node's mesh is part of the LOD 0 of a node above it
};

/// What a reader keeps of instances and images.
enum class Keep { kAll, kNothing };

class SceneReader {
 public:
  SceneReader(const Model& model, const Limits& limits, Keep keep, const SceneReading& reading)
      : model_(model),
        limits_(limits),
        keep_(keep),
        budget_{demandLimit(model, limits)},
        motion_(model, limits),
        cameras_(model, limits, motion_),
        pose_(model, motion_, reading.seconds),
        groups_(model),
        groupReader_(model, limits, pose_, groups_) {
    if (reading.plays) player_.emplace(model, motion_);
  }

  /// @param size  of the scene, for the vectors that are filled element by element
  SceneFile read(const SceneSize& size) {
    if (keep_ == Keep::kAll) {
      scene_.instances.reserve(size.instances);
      places_.reserve(size.instances);
    }
    scene_.images.edit().reserve(size.images.size());
    scene_.cameras.reserve(size.cameras);
    readMaterials();
    std::vector<Visit> stack;
    const std::vector<int> roots = sceneRoots(model_);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
      stack.push_back({*root, glm::dmat4(1.0)});
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(visit.node)];
      const glm::dmat4 worldFromNode = visit.worldFromParent * pose_.localTransform(visit.node);
      const bool isInGroup = visit.isInGroup || isLodGroup(model_, visit.node);
      readNode(visit, worldFromNode);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        stack.push_back({*child, worldFromNode, isInGroup});
    }
    scene_.rooms = roomsOf(model_);
    detail::placeNearOrigin(scene_, {places_, loosePlaces_});
    if (player_) {
      scene_.motion = player_->take(scene_.originWorld);
      detail::placeSkins(scene_, places_);
    }
    return std::move(scene_);
  }

  /// Animations that were not read, though they were asked for.
  const ContentCounts& notPlayed() const { return notPlayed_; }

 private:
  void readMaterials() {
    for (const tinygltf::Material& source : model_.materials)
      scene_.materials.push_back(detail::readMaterial(
          model_, source, [&](const detail::TextureReference& reference) { return imageIndex(reference); }));
    scene_.materials.emplace_back();
    scene_.materials.back().name = "default";
  }

  /// Decodes an image at its first use.
  std::uint32_t imageIndex(const detail::TextureReference& reference) {
    if (keep_ == Keep::kNothing) return 0;
    const auto [place, isNew] =
        imageIndex_.try_emplace({reference.image, reference.isData}, static_cast<std::uint32_t>(scene_.images.size()));
    if (!isNew) return place->second;
    ImageRgba8 decoded =
        detail::useImage(model_, static_cast<std::size_t>(reference.image),
                         [&](std::span<const std::byte> bytes) { return decodeImage(bytes, limits_.images); });
    takePixels(decoded);
    scene_.images.edit().push_back(std::move(decoded));
    return place->second;
  }

  void takePixels(const ImageRgba8& image) {
    pixelBytes_ += image.pixels.size();
    if (pixelBytes_ > limits_.maxFileBytes) throw Error(ErrorCode::kLimit, "the images are too large together");
  }

  void readNode(const Visit& visit, const glm::dmat4& worldFromNode) {
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(visit.node)];
    if (!isFinite(worldFromNode))
      throw Error(ErrorCode::kMalformed, fmt::format("node {}: transform is not finite", visit.node));
    if (node.camera >= 0) scene_.cameras.push_back(cameras_.read(visit.node, visit.worldFromParent, worldFromNode));
    const std::size_t before = scene_.instances.size();
    readTriangles(visit, worldFromNode);
    const bool isOne = isLodGroup(model_, visit.node);  // the instance is that of the whole group
    if (node.mesh >= 0)
      addLoose(visit.node, node.skin >= 0 ? glm::dmat4(1.0) : worldFromNode, isOne ? scene_.instances.size() : before);
  }

  void readTriangles(const Visit& visit, const glm::dmat4& worldFromNode) {
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(visit.node)];
    if (visit.isInGroup) return;
    if (isLodGroup(model_, visit.node)) {
      const std::optional<std::uint32_t> group = groupChainOf(visit.node, worldFromNode);
      if (!group) return;
      beginNode(visit.node);
      follow(visit.node, glm::dmat4(1.0));
      addInstance(*group, worldFromNode);
      return;
    }
    if (node.mesh < 0) return;
    const std::optional<std::uint32_t> chain = chainOf(visit.node);
    // The vertices of a skin are placed in the world by its joints; the node's own transform has no effect.
    if (chain) addInstances(visit.node, *chain, node.skin >= 0 ? glm::dmat4(1.0) : worldFromNode);
  }

  /// Index of the node's chain, made if new; nullopt if LOD 0 has no triangles.
  std::optional<std::uint32_t> chainOf(int node) {
    ChainKey<ShownMesh> key;
    key.levels = {shownMesh(model_, node)};
    for (const int lower : lodNodes(model_, node))
      key.levels.push_back(shownMesh(model_, lower));
    key.coverage = lodThresholds(model_.nodes[static_cast<std::size_t>(node)], key.levels.size());
    const auto known = chainIndex_.find(key);
    if (known != chainIndex_.end()) return known->second;

    Chain chain = makeChain(key.levels);
    chain.occluders = occludersOf(key.levels[0], chain);
    const std::optional<std::uint32_t> index = addChain(std::move(chain), key.coverage, node);
    chainIndex_.emplace(std::move(key), index);
    return index;
  }

  /// Occluders stay where they are, and so those of a mesh that is posed or bent are left out.
  std::vector<Occluder> occludersOf(const ShownMesh& finest, const Chain& chain) const {
    if (finest.posedNode >= 0 || chain.levels.empty()) return {};
    return meshOccluders(model_.meshes[static_cast<std::size_t>(finest.mesh)]);
  }

  /// Index of the chain; nullopt if it has no level.
  std::optional<std::uint32_t> addChain(Chain chain, const std::vector<float>& coverage, int node) {
    if (chain.levels.empty()) return std::nullopt;
    chain.coverage = coverage;
    chain.coverage.resize(std::min(coverage.size(), chain.levels.size()));
    const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
    const bool isNamed = !source.name.empty() || source.mesh < 0;
    chain.name = isNamed ? source.name : model_.meshes[static_cast<std::size_t>(source.mesh)].name;
    scene_.chains.push_back(std::move(chain));
    return static_cast<std::uint32_t>(scene_.chains.size() - 1);
  }

  /// As chainOf, for a group.
  std::optional<std::uint32_t> groupChainOf(int node, const glm::dmat4& worldFromNode) {
    ChainKey<detail::GroupLevel> key;
    key.levels = groups_.levelsOf(node);
    key.coverage = lodThresholds(model_.nodes[static_cast<std::size_t>(node)], key.levels.size());
    const auto known = groupIndex_.find(key);
    if (known != groupIndex_.end()) return known->second;

    const std::optional<std::uint32_t> index =
        addChain(makeGroupChain(key.levels, {node, worldFromNode}), key.coverage, node);
    groupIndex_.emplace(std::move(key), index);
    return index;
  }

  /// A chain ends at its first level without triangles. The errors of parts are those of the level only where it has
  /// as many parts as LOD 0.
  Chain makeGroupChain(const std::vector<detail::GroupLevel>& levels, const detail::GroupPlace& place) {
    Chain chain;
    std::size_t parts = 0;
    for (const detail::GroupLevel& source : levels) {
      const GroupMesh mesh = groupMesh(source, place);
      if (!mesh.level) break;
      LodLevel level = *mesh.level;
      if (chain.levels.empty()) {
        parts = mesh.parts;
        level = {level.mesh, 0.0F};
      } else if (mesh.parts != parts) {
        level = {level.mesh, std::numeric_limits<float>::infinity()};
      }
      chain.levels.push_back(level);
    }
    return chain;
  }

  /// A level of groups; none if it has no triangles.
  struct GroupMesh {
    std::optional<LodLevel> level;
    std::size_t parts = 0;
  };

  GroupMesh groupMesh(const detail::GroupLevel& level, const detail::GroupPlace& place) {
    const auto known = groupMeshes_.find(level);
    if (known != groupMeshes_.end()) return known->second;
    detail::LevelMesh read = groupReader_.read(level, place, scene_.materials, budget_);
    countAnimatedParts(level, place.group);
    GroupMesh mesh{std::nullopt, read.parts};
    if (!read.mesh.primitives.empty()) {
      mesh.level = {static_cast<std::uint32_t>(scene_.meshes.size()), read.errorObject, read.meanErrorObject};
      scene_.meshes.push_back(std::move(read.mesh));
    }
    groupMeshes_.emplace(level, mesh);
    return mesh;
  }

  /// Parts of a group stay as they are at rest.
  void countAnimatedParts(const detail::GroupLevel& level, int group) {
    if (!player_) return;
    const auto rest = [this](int node) { return localTransform(model_.nodes[static_cast<std::size_t>(node)]); };
    for (const detail::GroupPart& part : groups_.parts(level.content, rest))
      if (player_->movesWithin(part.node, group) || player_->bends(part.node))
        ++notPlayed_["poses of animated parts of groups with levels"];
  }

  /// A chain ends at its first level without triangles.
  Chain makeChain(const std::vector<ShownMesh>& meshes) {
    Chain chain;
    for (const ShownMesh& shown : meshes) {
      const std::optional<PosedMesh> mesh = posedMesh(shown);
      if (!mesh) break;
      LodLevel level{mesh->index, 0.0F};
      if (!chain.levels.empty()) {
        const std::optional<LodInfo> info = lodInfo(model_.meshes[static_cast<std::size_t>(shown.mesh)]);
        level.errorObject =
            info ? mesh->scale * static_cast<float>(info->errorObject) : std::numeric_limits<float>::infinity();
        if (info && info->measures)
          level.meanErrorObject = mesh->scale * static_cast<float>(info->measures->twoSided.mean);
      }
      chain.levels.push_back(level);
    }
    return chain;
  }

  /// A mesh that was read, and MeshPose::largestScale of its pose.
  struct PosedMesh {
    std::uint32_t index;
    float scale;
  };

  /// Reads a mesh at its first use; nullopt if it has no triangles.
  std::optional<PosedMesh> posedMesh(const ShownMesh& shown) {
    const auto known = meshes_.find(shown);
    if (known != meshes_.end()) return known->second;
    const detail::MeshPose pose = shown.posedNode >= 0 ? pose_.meshPose(shown.posedNode) : detail::MeshPose{};
    const bool isBent = player_ && shown.posedNode >= 0 && player_->bends(shown.posedNode);
    const detail::BendingTables tables = isBent ? player_->tablesOf(shown.posedNode) : detail::BendingTables{};
    MeshBending bending;
    Mesh read = detail::readMesh(model_, shown.mesh, {scene_.materials, budget_, pose, isBent ? &tables : nullptr},
                                 &bending.primitives);
    std::optional<PosedMesh> mesh;
    if (!read.primitives.empty()) {
      const bool isLevel = lodInfo(model_.meshes[static_cast<std::size_t>(shown.mesh)]).has_value();
      const double scale = isBent && isLevel ? player_->largestScale(shown.posedNode) : pose.largestScale();
      mesh = {static_cast<std::uint32_t>(scene_.meshes.size()), static_cast<float>(scale)};
      bending.mesh = mesh->index;
      bending.firstWeight = tables.firstWeight;
      if (isBent) player_->addMesh(std::move(bending));
      scene_.meshes.push_back(std::move(read));
    }
    meshes_.emplace(shown, mesh);
    return mesh;
  }

  void addInstances(int node, std::uint32_t chain, const glm::dmat4& worldFromNode) {
    const InstanceTransforms instances = readInstances(model_, node, limits_);
    beginNode(node);
    if (instances.count == 0) {
      follow(node, glm::dmat4(1.0));
      addInstance(chain, worldFromNode);
    }
    const bool once = keep_ == Keep::kNothing && instances.areEqual();
    for (std::uint64_t i = 0; i < (once ? 1 : instances.count); ++i) {
      const glm::dmat4 nodeFromInstance = instances.nodeFromInstance(i);
      const glm::dmat4 worldFromObject = worldFromNode * nodeFromInstance;
      if (!isFinite(glm::dmat4(glm::mat4(worldFromObject))))
        throw Error(ErrorCode::kMalformed, fmt::format("node {}: instance {} is not finite", node, i));
      follow(node, nodeFromInstance);
      addInstance(chain, worldFromObject);
    }
  }

  /// Notes that the instance which is added next follows a node.
  void follow(int node, const glm::dmat4& nodeFromInstance) {
    if (keep_ == Keep::kAll && player_ && model_.nodes[static_cast<std::size_t>(node)].skin < 0)
      player_->addInstance(static_cast<std::uint32_t>(scene_.instances.size()), node, nodeFromInstance);
  }

  /// The same for points and lines. Those that a skin or morph targets move stay as they are at rest.
  void followLoose(int node, const glm::dmat4& nodeFromInstance) {
    if (!player_) return;
    if (player_->bends(node)) ++notPlayed_["poses of animated points and lines"];
    if (model_.nodes[static_cast<std::size_t>(node)].skin < 0)
      player_->addLooseInstance(static_cast<std::uint32_t>(scene_.looseInstances.size()), node, nodeFromInstance);
  }

  /// Adds the points and lines of a node's mesh. @param first  the instance that the node's first one is, if it has any
  void addLoose(int node, const glm::dmat4& worldFromNode, std::size_t first) {
    const std::optional<std::uint32_t> geometry = looseGeometry(shownMesh(model_, node));
    if (!geometry) return;
    const LooseGeometry& shown = scene_.looseGeometries[*geometry];
    const InstanceTransforms instances = readInstances(model_, node, limits_);
    const std::uint64_t copies = std::max<std::uint64_t>(instances.count, 1);
    // Each instance gets vertices of its own.
    budget_.take(saturatingProduct(copies, shown.points.size() + shown.lines.size()));
    if (keep_ != Keep::kAll) return;
    for (std::uint64_t i = 0; i < copies; ++i) {
      const glm::dmat4 own = instances.count > 0 ? instances.nodeFromInstance(i) : glm::dmat4(1.0);
      const glm::dmat4 world = worldFromNode * own;
      if (!isFinite(glm::dmat4(glm::mat4(world))))
        throw Error(ErrorCode::kMalformed, fmt::format("node {}: instance {} is not finite", node, i));
      std::optional<std::uint32_t> instance;
      if (first + i < scene_.instances.size()) instance = static_cast<std::uint32_t>(first + i);
      followLoose(node, own);
      scene_.looseInstances.push_back({*geometry, glm::mat4(world), instance});
      loosePlaces_.emplace_back(world[3]);
    }
  }

  /// Reads the points and lines of a mesh at its first use; nullopt if it has none.
  std::optional<std::uint32_t> looseGeometry(const ShownMesh& shown) {
    const auto known = looseIndex_.find(shown);
    if (known != looseIndex_.end()) return known->second;
    std::optional<std::uint32_t> index;
    if (detail::hasLooseGeometry(model_.meshes[static_cast<std::size_t>(shown.mesh)])) {
      const detail::MeshPose pose = shown.posedNode >= 0 ? pose_.meshPose(shown.posedNode) : detail::MeshPose{};
      index = static_cast<std::uint32_t>(scene_.looseGeometries.size());
      scene_.looseGeometries.push_back(
          detail::readLooseGeometry(model_, shown.mesh, {scene_.materials, budget_, pose}));
    }
    looseIndex_.emplace(shown, index);
    return index;
  }

  /// The node whose instances come next.
  void beginNode(int node) {
    if (keep_ == Keep::kAll) scene_.nodeNames.edit().push_back(model_.nodes[static_cast<std::size_t>(node)].name);
  }

  void addInstance(std::uint32_t chain, const glm::dmat4& worldFromObject) {
    if (keep_ != Keep::kAll) return;
    const auto name = static_cast<std::uint32_t>(scene_.nodeNames.size() - 1);
    scene_.instances.push_back({chain, glm::mat4(worldFromObject), name});
    places_.emplace_back(worldFromObject[3]);
  }

  const Model& model_;
  const Limits& limits_;
  Keep keep_;
  detail::ElementBudget budget_;
  NodeMotion motion_;
  detail::CameraReader cameras_;
  detail::ScenePose pose_;
  detail::LodGroups groups_;
  detail::GroupReader groupReader_;
  std::optional<detail::MotionReader> player_;  ///< if animations are read
  ContentCounts notPlayed_;
  std::uint64_t pixelBytes_ = 0;
  SceneFile scene_;
  std::vector<glm::dvec3> places_;                            ///< of the instances' origins
  std::vector<glm::dvec3> loosePlaces_;                       ///< the same for points and lines
  std::map<std::pair<int, bool>, std::uint32_t> imageIndex_;  ///< by picture and TextureReference::isData
  std::map<ShownMesh, std::optional<PosedMesh>> meshes_;
  std::map<ShownMesh, std::optional<std::uint32_t>> looseIndex_;
  std::map<ChainKey<ShownMesh>, std::optional<std::uint32_t>> chainIndex_;
  std::map<detail::GroupLevel, GroupMesh> groupMeshes_;
  std::map<ChainKey<detail::GroupLevel>, std::optional<std::uint32_t>> groupIndex_;
};

SceneFile read(const Model& model, const std::filesystem::path& path, const Limits& limits, Keep keep,
               const SceneReading& reading) {
  try {
    SceneSize size = measureScene(model, limits);
    if (!reading.plays) size.motionBytes = 0;
    if (size.instances > limits.maxInstances)
      throw Error(ErrorCode::kLimit, fmt::format("{} instances, the limit is {}", size.instances, limits.maxInstances));
    if (reading.check) reading.check(size);
    SceneReader reader(model, limits, keep, reading);
    SceneFile scene = reader.read(size);
    scene.ignored = ignoredContent(model, reading.seconds.has_value() || reading.plays);
    scene.ignored.insert(reader.notPlayed().begin(), reader.notPlayed().end());
    return scene;
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw Error(error.code(), error.what(), path);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::kLimit, "out of memory", path);
  }
}

}  // namespace

SceneFile readSceneFile(const std::filesystem::path& path, const Limits& limits, const ReadObserver& observer,
                        const SceneReading& reading) {
  return readScene(loadGltf(path, limits, observer), path, limits, reading);
}

SceneFile readScene(const Model& model, const std::filesystem::path& path, const Limits& limits,
                    const SceneReading& reading) {
  return read(model, path, limits, Keep::kAll, reading);
}

void checkScene(const Model& model, const std::filesystem::path& path, const Limits& limits) {
  read(model, path, limits, Keep::kNothing, {});
}

}  // namespace jalousie::asset
