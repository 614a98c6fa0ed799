// EXT_mesh_gpu_instancing as tinygltf values and accessors.
#include "asset/instancing.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "asset/accessor.h"
#include "asset/accessor_layout.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

[[noreturn]] void malformed(int node, const char* what) {
  throw Error(ErrorCode::kMalformed, fmt::format("node {}: {} {}", node, kExtension, what));
}

/// Accessor of one attribute, -1 if absent.
int attribute(const tinygltf::Value& attributes, const char* name, int node) {
  if (!attributes.Has(name)) return -1;
  const tinygltf::Value& value = attributes.Get(name);
  if (!value.IsInt()) malformed(node, "attribute is not an accessor index");
  return value.Get<int>();
}

/// Number of instances: the same for all attributes, whether we know them or not.
std::size_t instanceCount(const tinygltf::Model& model, const tinygltf::Value& attributes, int node) {
  std::size_t count = 0;
  for (const std::string& name : attributes.Keys()) {
    const int accessor = attribute(attributes, name.c_str(), node);
    detail::requireIndex(accessor, model.accessors.size(), fmt::format("node {}: instance accessor", node));
    const std::size_t own = model.accessors[static_cast<std::size_t>(accessor)].count;
    if (count != 0 && own != count) malformed(node, "attributes differ in count");
    count = own;
  }
  return count;
}

}  // namespace

tinygltf::Value appendInstances(tinygltf::Model& model, const Instances& instances) {
  JAL_CHECK(instances.rotations.size() == instances.translations.size());
  JAL_CHECK(instances.scales.size() == instances.translations.size());
  tinygltf::Value::Object attributes;
  attributes["TRANSLATION"] = tinygltf::Value(appendVec3(model, instances.translations, 0));
  attributes["ROTATION"] = tinygltf::Value(appendQuaternions(model, instances.rotations, 0));
  attributes["SCALE"] = tinygltf::Value(appendVec3(model, instances.scales, 0));
  std::vector<std::string>& used = model.extensionsUsed;
  if (std::find(used.begin(), used.end(), kExtension) == used.end()) used.emplace_back(kExtension);
  return tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(std::move(attributes))}});
}

Instances readInstances(const tinygltf::Model& model, int node, const Limits& limits) {
  detail::requireIndex(node, model.nodes.size(), "node");
  const tinygltf::ExtensionMap& extensions = model.nodes[static_cast<std::size_t>(node)].extensions;
  const auto found = extensions.find(kExtension);
  if (found == extensions.end()) return {};
  if (!found->second.IsObject() || !found->second.Get("attributes").IsObject()) malformed(node, "has no attributes");
  const tinygltf::Value& attributes = found->second.Get("attributes");
  const std::size_t count = instanceCount(model, attributes, node);
  if (count == 0) malformed(node, "has no attributes");
  if (count > limits.maxInstances)
    throw Error(ErrorCode::kLimit,
                fmt::format("node {}: {} instances, the limit is {}", node, count, limits.maxInstances));

  Instances instances;
  const int translation = attribute(attributes, "TRANSLATION", node);
  const int rotation = attribute(attributes, "ROTATION", node);
  const int scale = attribute(attributes, "SCALE", node);
  instances.translations = translation >= 0 ? readVec3(model, translation, limits.maxInstances)
                                            : std::vector<glm::vec3>(count, glm::vec3(0.0F));
  instances.rotations = rotation >= 0 ? readQuaternions(model, rotation, limits.maxInstances)
                                      : std::vector<glm::quat>(count, glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
  instances.scales =
      scale >= 0 ? readVec3(model, scale, limits.maxInstances) : std::vector<glm::vec3>(count, glm::vec3(1.0F));
  return instances;
}

}  // namespace jalousie::asset
