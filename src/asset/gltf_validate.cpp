// Every index, range and the node forest of a model; iterative throughout.
#include "asset/gltf_validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/accessor_layout.h"
#include "asset/camera_validate.h"
#include "asset/gltf_images.h"
#include "asset/lod_cell_levels.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "asset/mesh_occluders.h"
#include "asset/node_graph.h"
#include "asset/scene_rooms.h"
#include "core/error.h"

namespace jalousie::asset::detail {

void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

namespace {

using tinygltf::Model;

/// As requireIndex, where -1 means absent.
void requireOptional(int index, std::size_t size, const char* owner, std::size_t ownerIndex, const char* what) {
  if (index == -1) return;
  if (index < 0 || static_cast<std::size_t>(index) >= size)
    malformed(fmt::format("{} {}: {} {} is out of range, there are {}", owner, ownerIndex, what, index, size));
}

void requireLength(const std::vector<double>& values, std::size_t length, const char* owner, std::size_t index,
                   const char* what) {
  if (!values.empty() && values.size() != length)
    malformed(fmt::format("{} {}: {} has {} numbers, not {}", owner, index, what, values.size(), length));
}

/// Numbers that are used as floats must be finite as floats. @param what  "node 3: scale", for the message
void requireFinite(const std::vector<double>& values, const std::string& what) {
  for (const double value : values)
    if (!std::isfinite(static_cast<float>(value))) malformed(fmt::format("{} is not finite: {:g}", what, value));
}

/// min and max have a number for each component. tinygltf writes them as they are.
void validateBounds(const tinygltf::Accessor& accessor, std::size_t index) {
  for (const auto& [bounds, name] : {std::pair(&accessor.minValues, "min"), std::pair(&accessor.maxValues, "max")}) {
    if (!bounds->empty() && bounds->size() != componentCount(accessor.type))
      malformed(fmt::format("accessor {}: {} has {} numbers, its elements have {}", index, name, bounds->size(),
                            componentCount(accessor.type)));
    requireFinite(*bounds, fmt::format("accessor {}: {}", index, name));
  }
}

/// Views and accessors lie in what holds them; the rest of validateData relies on it.
void validateRanges(const Model& model, const Limits& limits) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i)
    viewBytes(model, static_cast<int>(i));
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const int index = static_cast<int>(i);
    baseElements(model, index, limits.maxAccessorElements);
    validateBounds(model.accessors[i], i);
    if (model.accessors[i].bufferView < 0 && model.accessors[i].byteOffset > 0)
      malformed(fmt::format("accessor {} has an offset into no buffer view", i));
    if (model.accessors[i].sparse.isSparse) sparseElements(model, index);
  }
}

void validateTextureInfo(const Model& model, int index, std::size_t material) {
  requireOptional(index, model.textures.size(), "material", material, "texture");
}

void validateMaterials(const Model& model) {
  for (std::size_t i = 0; i < model.images.size(); ++i)
    requireOptional(model.images[i].bufferView, model.bufferViews.size(), "image", i, "buffer view");
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    requireOptional(model.textures[i].sampler, model.samplers.size(), "texture", i, "sampler");
    requireOptional(model.textures[i].source, model.images.size(), "texture", i, "image");
    requireOptional(imageOfTexture(model.textures[i]), model.images.size(), "texture", i, "image");
  }
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& material = model.materials[i];
    validateTextureInfo(model, material.pbrMetallicRoughness.baseColorTexture.index, i);
    validateTextureInfo(model, material.pbrMetallicRoughness.metallicRoughnessTexture.index, i);
    validateTextureInfo(model, material.normalTexture.index, i);
    validateTextureInfo(model, material.occlusionTexture.index, i);
    validateTextureInfo(model, material.emissiveTexture.index, i);
    requireLength(material.pbrMetallicRoughness.baseColorFactor, 4, "material", i, "baseColorFactor");
    requireLength(material.emissiveFactor, 3, "material", i, "emissiveFactor");
  }
}

void validateAttributes(const Model& model, const std::map<std::string, int>& attributes, std::size_t mesh) {
  for (const auto& [name, accessor] : attributes) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size())
      malformed(fmt::format("mesh {}: attribute accessor {} is out of range", mesh, accessor));
  }
}

/// Weights of morph targets, one for each target. @param owner  "mesh 3" or "node 3", for the message
void validateWeights(const std::vector<double>& weights, const tinygltf::Mesh& mesh, const std::string& owner) {
  const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
  if (!weights.empty() && weights.size() != targets)
    malformed(fmt::format("{}: {} weights for {} morph targets", owner, weights.size(), targets));
  requireFinite(weights, owner + ": weights");
}

void validatePrimitive(const Model& model, const tinygltf::Primitive& primitive, std::size_t mesh) {
  const std::size_t targets = model.meshes[mesh].primitives[0].targets.size();
  if (primitive.targets.size() != targets)
    malformed(
        fmt::format("mesh {}: its primitives have {} and {} morph targets", mesh, targets, primitive.targets.size()));
  validateAttributes(model, primitive.attributes, mesh);
  for (const auto& target : primitive.targets)
    validateAttributes(model, target, mesh);
  requireOptional(primitive.indices, model.accessors.size(), "mesh", mesh, "index accessor");
  requireOptional(primitive.material, model.materials.size(), "mesh", mesh, "material");
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    malformed(fmt::format("mesh {}: primitive mode {}", mesh, primitive.mode));
}

/// @return  the number of cells of each mesh, 0 where it is not divided
std::vector<std::size_t> validateMeshes(const Model& model) {
  std::vector<std::size_t> cells;
  cells.reserve(model.meshes.size());
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    const tinygltf::Mesh& mesh = model.meshes[i];
    validateWeights(mesh.weights, mesh, fmt::format("mesh {}", i));
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      validatePrimitive(model, primitive, i);
    try {
      lodInfo(mesh);
      lodFaces(model, mesh);
      cells.push_back(cellCount(lodCells(model, mesh)));
      lodCellLevels(model, mesh);
      meshOccluders(mesh);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("mesh {}: {}", i, error.what()));
    }
  }
  return cells;
}

/// A cell has the same number in all levels of a chain. Reads the meshes of other nodes: every reference to a mesh has
/// been checked.
void validateCells(const Model& model, std::size_t node, int level, const std::vector<std::size_t>& cells) {
  const int finest = model.nodes[node].mesh;
  const int mesh = model.nodes[static_cast<std::size_t>(level)].mesh;
  const std::size_t expected = cells[static_cast<std::size_t>(finest)];
  const std::size_t found = cells[static_cast<std::size_t>(mesh)];
  if (found != expected)
    malformed(fmt::format("node {}: mesh {} has {} cells, mesh {} of the same chain has {}", node, mesh, found, finest,
                          expected));
}

void validateInstancing(const Model& model, const tinygltf::Node& node, std::size_t index) {
  const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
  if (found == node.extensions.end()) return;
  if (!found->second.IsObject() || !found->second.Get("attributes").IsObject())
    malformed(fmt::format("node {}: instancing without attributes", index));
  for (const auto& [name, value] : found->second.Get("attributes").Get<tinygltf::Value::Object>()) {
    if (!value.IsInt() || value.Get<int>() < 0)
      malformed(fmt::format("node {}: instance attribute is no accessor", index));
    requireOptional(value.Get<int>(), model.accessors.size(), "node", index, "instance accessor");
  }
}

/// The groups of the cells of a chain fit each other. @param known  chains that were checked
void validateCellLevels(const Model& model, std::size_t node, std::set<std::vector<int>>& known) {
  std::vector<int> meshes = {model.nodes[node].mesh};
  for (const int level : lodNodes(model, static_cast<int>(node)))
    meshes.push_back(model.nodes[static_cast<std::size_t>(level)].mesh);
  if (meshes.size() < 2 || !known.insert(meshes).second) return;
  std::vector<LodCellLevels> levels;
  for (const int mesh : meshes)
    levels.push_back(lodCellLevels(model, model.meshes[static_cast<std::size_t>(mesh)]));
  try {
    requireHierarchy(levels);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("node {}: {}", node, error.what()));
  }
}

/// @param cells  of each mesh
void validateLevels(const Model& model, const std::vector<std::size_t>& cells) {
  std::set<std::vector<int>> known;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const bool isGroup = isLodGroup(model, static_cast<int>(i));
    for (const int level : lodIds(model, static_cast<int>(i))) {
      if (model.nodes[static_cast<std::size_t>(level)].extensions.contains("MSFT_lod"))
        malformed(fmt::format("node {}: MSFT_lod node {} has levels of its own", i, level));
      if (!isGroup) validateCells(model, i, level, cells);
    }
    validateCellLevels(model, i, known);
  }
}

void validateNodes(const Model& model) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const tinygltf::Node& node = model.nodes[i];
    requireOptional(node.mesh, model.meshes.size(), "node", i, "mesh");
    requireOptional(node.camera, model.cameras.size(), "node", i, "camera");
    requireOptional(node.skin, model.skins.size(), "node", i, "skin");
    requireLength(node.matrix, 16, "node", i, "matrix");
    requireLength(node.translation, 3, "node", i, "translation");
    requireLength(node.rotation, 4, "node", i, "rotation");
    requireLength(node.scale, 3, "node", i, "scale");
    if (!node.weights.empty()) {
      if (node.mesh < 0) malformed(fmt::format("node {} has weights of morph targets and no mesh", i));
      validateWeights(node.weights, model.meshes[static_cast<std::size_t>(node.mesh)], fmt::format("node {}", i));
    }
    validateInstancing(model, node, i);
  }
}

/// localTransform with the node's index in its message. Errors: kMalformed (a rotation without direction, a transform
/// that is not finite as floats or not affine).
glm::dmat4 nodeTransform(const tinygltf::Node& node, int index) {
  const glm::dmat4 local = [&] {
    try {
      return localTransform(node);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("node {}: {}", index, error.what()));
    }
  }();
  if (!isFinite(local)) malformed(fmt::format("node {}: transform is not finite", index));
  if (glm::row(local, 3) != glm::dvec4(0.0, 0.0, 0.0, 1.0))
    malformed(fmt::format("node {}: the last row of the matrix is not 0 0 0 1", index));
  return local;
}

std::vector<std::uint8_t> markChildren(const Model& model) {
  std::vector<std::uint8_t> isChild(model.nodes.size(), 0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children) {
      requireIndex(child, model.nodes.size(), "child node");
      if (isChild[static_cast<std::size_t>(child)]++ != 0) malformed(fmt::format("node {} has two parents", child));
    }
  }
  return isChild;
}

/// Follows the hierarchy from its roots. With at most one parent per node, a cycle is a part that no root reaches.
/// Every product of transforms must be finite.
void validateHierarchy(const Model& model, const std::vector<std::uint8_t>& isChild) {
  struct Visit {
    int node;
    glm::dmat4 worldFromParent;
  };
  std::vector<Visit> stack;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (isChild[i] == 0) stack.push_back({static_cast<int>(i), glm::dmat4(1.0)});
  }
  std::size_t reached = 0;
  while (!stack.empty()) {
    const auto [index, worldFromParent] = stack.back();
    stack.pop_back();
    ++reached;
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    const glm::dmat4 worldFromNode = worldFromParent * nodeTransform(node, index);
    if (!isFinite(worldFromNode)) malformed(fmt::format("node {}: transform is not finite", index));
    for (const int child : node.children)
      stack.push_back({child, worldFromNode});
  }
  if (reached != model.nodes.size()) malformed("the node hierarchy has a cycle");
}

/// Scenes list nodes, each once. Some exporters list children of other nodes, too.
void validateScenes(const Model& model) {
  std::vector<std::size_t> lastListed(model.nodes.size(), 0);  // 1 + the last scene that lists a node
  for (std::size_t s = 0; s < model.scenes.size(); ++s) {
    try {
      roomsOf(model.scenes[s]);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("scene {}: {}", s, error.what()));
    }
    for (const int root : model.scenes[s].nodes) {
      requireIndex(root, model.nodes.size(), "scene node");
      std::size_t& last = lastListed[static_cast<std::size_t>(root)];
      if (last == s + 1) malformed(fmt::format("scene lists node {} twice", root));
      last = s + 1;
    }
  }
  requireOptional(model.defaultScene, model.scenes.size(), "document", 0, "scene");
}

void validateCameras(const Model& model) {
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    validateLens(model.cameras[i], i);
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What a channel moves. KHR_animation_pointer names it in the extension.
void validatePath(const tinygltf::AnimationChannel& channel, std::size_t animation) {
  const bool pointer = channel.target_path == "pointer" && channel.target_extensions.contains("KHR_animation_pointer");
  if (!pointer && !isOneOf(channel.target_path, {"translation", "rotation", "scale", "weights"}))
    malformed(fmt::format("animation {}: path \"{}\" is not known", animation, oneLine(channel.target_path)));
}

void validateAnimations(const Model& model) {
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    const tinygltf::Animation& animation = model.animations[i];
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      requireIndex(channel.sampler, animation.samplers.size(), fmt::format("animation {}: sampler", i));
      requireOptional(channel.target_node, model.nodes.size(), "animation", i, "node");
      validatePath(channel, i);
    }
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      requireIndex(sampler.input, model.accessors.size(), fmt::format("animation {}: input accessor", i));
      requireIndex(sampler.output, model.accessors.size(), fmt::format("animation {}: output accessor", i));
      if (!sampler.interpolation.empty() && !isOneOf(sampler.interpolation, {"LINEAR", "STEP", "CUBICSPLINE"}))
        malformed(fmt::format("animation {}: interpolation \"{}\" is not known", i, oneLine(sampler.interpolation)));
    }
  }
}

void validateSkins(const Model& model) {
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& skin = model.skins[i];
    requireOptional(skin.inverseBindMatrices, model.accessors.size(), "skin", i, "accessor");
    requireOptional(skin.skeleton, model.nodes.size(), "skin", i, "skeleton");
    for (const int joint : skin.joints)
      requireIndex(joint, model.nodes.size(), fmt::format("skin {}: joint", i));
  }
}

}  // namespace

void validateModel(const Model& model, const Limits& limits) {
  validateRanges(model, limits);
  validateMaterials(model);
  const std::vector<std::size_t> cells = validateMeshes(model);
  validateNodes(model);
  validateLevels(model, cells);
  const std::vector<std::uint8_t> isChild = markChildren(model);
  validateHierarchy(model, isChild);
  validateScenes(model);
  validateCameras(model);
  validateAnimations(model);
  validateSkins(model);
  validateData(model, limits);
}

}  // namespace jalousie::asset::detail
