// Every index, range and the node forest of a model; iterative throughout.
#include "asset/gltf_validate.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "asset/accessor_layout.h"
#include "asset/gltf_images.h"
#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using tinygltf::Model;

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

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

/// Views and accessors lie in what holds them; the rest of validateData relies on it.
void validateRanges(const Model& model, const Limits& limits) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i)
    viewBytes(model, static_cast<int>(i));
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const int index = static_cast<int>(i);
    baseElements(model, index, limits.maxAccessorElements);
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

void validateMeshes(const Model& model) {
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    for (const tinygltf::Primitive& primitive : model.meshes[i].primitives) {
      validateAttributes(model, primitive.attributes, i);
      for (const auto& target : primitive.targets)
        validateAttributes(model, target, i);
      requireOptional(primitive.indices, model.accessors.size(), "mesh", i, "index accessor");
      requireOptional(primitive.material, model.materials.size(), "mesh", i, "material");
      if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        malformed(fmt::format("mesh {}: primitive mode {}", i, primitive.mode));
    }
  }
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
    localTransform(node);  // a rotation has a direction
    validateInstancing(model, node, i);
    for (const int level : lodNodes(model, static_cast<int>(i)))
      if (model.nodes[static_cast<std::size_t>(level)].extensions.contains("MSFT_lod"))
        malformed(fmt::format("node {}: MSFT_lod node {} has levels of its own", i, level));
  }
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

/// With at most one parent per node, a cycle is a part that no root reaches.
void validateForest(const Model& model) {
  const std::vector<std::uint8_t> isChild = markChildren(model);
  std::vector<int> stack;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (isChild[i] == 0) stack.push_back(static_cast<int>(i));
  }
  std::size_t reached = 0;
  while (!stack.empty()) {
    const auto node = static_cast<std::size_t>(stack.back());
    stack.pop_back();
    ++reached;
    const std::vector<int>& children = model.nodes[node].children;
    stack.insert(stack.end(), children.begin(), children.end());
  }
  if (reached != model.nodes.size()) malformed("the node hierarchy has a cycle");

  std::vector<std::size_t> lastListed(model.nodes.size(), 0);  // 1 + the last scene that lists a node
  for (std::size_t s = 0; s < model.scenes.size(); ++s) {
    for (const int root : model.scenes[s].nodes) {
      requireIndex(root, model.nodes.size(), "scene node");
      if (isChild[static_cast<std::size_t>(root)] != 0) malformed(fmt::format("scene node {} is no root", root));
      std::size_t& last = lastListed[static_cast<std::size_t>(root)];
      if (last == s + 1) malformed(fmt::format("scene lists node {} twice", root));
      last = s + 1;
    }
  }
  requireOptional(model.defaultScene, model.scenes.size(), "document", 0, "scene");
}

void validateCameras(const Model& model) {
  for (std::size_t i = 0; i < model.cameras.size(); ++i) {
    const tinygltf::Camera& camera = model.cameras[i];
    bool valid = false;
    if (camera.type == "perspective") {
      const tinygltf::PerspectiveCamera& lens = camera.perspective;
      valid = lens.yfov > 0.0 && lens.znear > 0.0 && lens.aspectRatio >= 0.0 &&
              (lens.zfar == 0.0 || lens.zfar > lens.znear);
    } else if (camera.type == "orthographic") {
      const tinygltf::OrthographicCamera& lens = camera.orthographic;
      valid = lens.xmag != 0.0 && lens.ymag != 0.0 && lens.znear >= 0.0 && lens.zfar > lens.znear;
    }
    if (!valid) malformed(fmt::format("camera {} has no lens that sees anything", i));
  }
}

void validateAnimations(const Model& model) {
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    const tinygltf::Animation& animation = model.animations[i];
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      requireIndex(channel.sampler, animation.samplers.size(), fmt::format("animation {}: sampler", i));
      requireOptional(channel.target_node, model.nodes.size(), "animation", i, "node");
    }
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      requireIndex(sampler.input, model.accessors.size(), fmt::format("animation {}: input accessor", i));
      requireIndex(sampler.output, model.accessors.size(), fmt::format("animation {}: output accessor", i));
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
  validateMeshes(model);
  validateNodes(model);
  validateForest(model);
  validateCameras(model);
  validateAnimations(model);
  validateSkins(model);
  validateData(model, limits);
}

}  // namespace jalousie::asset::detail
