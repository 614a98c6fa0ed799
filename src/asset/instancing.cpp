// EXT_mesh_gpu_instancing as tinygltf values and accessors.
#include "asset/instancing.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "asset/accessor.h"
#include "asset/accessor_layout.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

[[noreturn]] void malformed(int node, const char* what) {
  throw Error(ErrorCode::kMalformed, fmt::format("node {}: {} {}", node, kInstancing, what));
}

/// Accessor of one attribute, -1 if absent.
int attribute(const tinygltf::Value& attributes, const char* name, int node) {
  if (!attributes.Has(name)) return -1;
  const tinygltf::Value& value = attributes.Get(name);
  if (!value.IsInt()) malformed(node, "attribute is not an accessor index");
  return value.Get<int>();
}

/// Number of instances: the same for all attributes, whether we know them or not.
std::size_t commonCount(const tinygltf::Model& model, const tinygltf::Value& attributes, int node) {
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

/// Accessors of the known attributes, -1 where absent.
struct Attributes {
  std::uint64_t count = 0;  ///< of instances; 0 if the node has no such extension
  int translation = -1;
  int rotation = -1;
  int scale = -1;
};

Attributes attributesOf(const tinygltf::Model& model, int node, const Limits& limits) {
  detail::requireIndex(node, model.nodes.size(), "node");
  const tinygltf::ExtensionMap& extensions = model.nodes[static_cast<std::size_t>(node)].extensions;
  const auto found = extensions.find(kInstancing);
  if (found == extensions.end()) return {};
  if (!found->second.IsObject() || !found->second.Get("attributes").IsObject()) malformed(node, "has no attributes");
  const tinygltf::Value& attributes = found->second.Get("attributes");
  const std::size_t count = commonCount(model, attributes, node);
  if (count == 0) malformed(node, "has no attributes");
  if (count > limits.maxInstances)
    throw Error(ErrorCode::kLimit,
                fmt::format("node {}: {} instances, the limit is {}", node, count, limits.maxInstances));
  return {count, attribute(attributes, "TRANSLATION", node), attribute(attributes, "ROTATION", node),
          attribute(attributes, "SCALE", node)};
}

/// Whether the file holds every element of an accessor; the others are zeros.
bool isComplete(const tinygltf::Accessor& accessor) {
  const bool replaced =
      accessor.sparse.isSparse && static_cast<std::uint64_t>(std::max(accessor.sparse.count, 0)) >= accessor.count;
  return accessor.bufferView >= 0 || replaced;
}

/// Type, range and numbers of an accessor of vectors.
void checkVectors(const tinygltf::Model& model, int node, int accessor, const Limits& limits) {
  if (accessor < 0) return;
  detail::baseElements(model, accessor, limits.maxInstances);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  if (source.type != TINYGLTF_TYPE_VEC3)
    throw Error(ErrorCode::kMalformed, fmt::format("accessor {} has the wrong type for its use", accessor));
  if (!holdsFiniteNumbers(model, accessor))
    throw Error(ErrorCode::kMalformed, fmt::format("node {}: an instance's translation or scale is not finite", node));
}

/// A rotation that the file does not hold would have no direction.
void checkRotations(const tinygltf::Model& model, int accessor) {
  if (accessor >= 0 && !isComplete(model.accessors[static_cast<std::size_t>(accessor)]))
    throw Error(ErrorCode::kMalformed, fmt::format("accessor {} holds a quaternion without direction", accessor));
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
  if (std::find(used.begin(), used.end(), kInstancing) == used.end()) used.emplace_back(kInstancing);
  return tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(std::move(attributes))}});
}

std::uint64_t countInstances(const tinygltf::Model& model, int node, const Limits& limits) {
  return attributesOf(model, node, limits).count;
}

std::uint64_t checkInstances(const tinygltf::Model& model, int node, const Limits& limits) {
  const Attributes found = attributesOf(model, node, limits);
  checkVectors(model, node, found.translation, limits);
  checkVectors(model, node, found.scale, limits);
  checkRotations(model, found.rotation);
  if (found.rotation >= 0) readQuaternions(model, found.rotation, limits.maxInstances);
  return found.count;
}

glm::dmat4 InstanceTransforms::nodeFromInstance(std::uint64_t i) const {
  const auto at = [i](const auto& of) { return of[of.size() == 1 ? 0 : i]; };
  return glm::translate(glm::dmat4(1.0), glm::dvec3(at(values.translations))) *
         glm::mat4_cast(glm::dquat(at(values.rotations))) * glm::scale(glm::dmat4(1.0), glm::dvec3(at(values.scales)));
}

bool InstanceTransforms::areEqual() const {
  return values.translations.size() == 1 && values.rotations.size() == 1 && values.scales.size() == 1;
}

InstanceTransforms readInstances(const tinygltf::Model& model, int node, const Limits& limits) {
  const Attributes found = attributesOf(model, node, limits);
  if (found.count == 0) return {};
  const auto vectors = [&](int accessor, float missing) {
    if (accessor < 0) return std::vector<glm::vec3>{glm::vec3(missing)};
    const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
    if (source.bufferView >= 0 || source.sparse.isSparse) return readVec3(model, accessor, limits.maxInstances);
    checkVectors(model, node, accessor, limits);
    return std::vector<glm::vec3>{glm::vec3(0.0F)};
  };
  checkRotations(model, found.rotation);
  return {found.count,
          {vectors(found.translation, 0.0F),
           found.rotation >= 0 ? readQuaternions(model, found.rotation, limits.maxInstances)
                               : std::vector<glm::quat>{glm::quat(1.0F, 0.0F, 0.0F, 0.0F)},
           vectors(found.scale, 1.0F)}};
}

}  // namespace jalousie::asset
