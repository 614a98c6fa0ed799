// What accessors hold, by the use that is made of them. Each accessor is looked at once, however often it is used.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/accessor.h"
#include "asset/accessor_layout.h"
#include "asset/gltf_validate.h"
#include "asset/mesh_occluders.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using tinygltf::Model;

/// Bytes of accessors over bytes of buffers: overlap beyond this costs more time than any honest file asks for.
constexpr std::uint64_t kMaxOverlap = 16;
constexpr std::uint64_t kFreeAccessorBytes = 1ULL << 26U;

void checkDemand(const Model& model, const Limits& limits) {
  std::uint64_t empty = 0;
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = model.accessors[i];
    // Every count is at most maxAccessorElements by now, and there are fewer than 2^31 accessors.
    const std::uint64_t elementSize = elementBytes(accessor.type, accessor.componentType);
    bytes += accessor.count * elementSize;
    if (accessor.sparse.isSparse)
      bytes += static_cast<std::uint64_t>(accessor.sparse.count) *
               (elementSize + componentBytes(accessor.sparse.indices.componentType));
    if (accessor.bufferView >= 0) continue;
    if (!accessor.sparse.isSparse) empty += accessor.count;  // morph targets are sparse, many, and honest
    if (accessor.count > limits.maxEmptyElements || empty > limits.maxEmptyElements)
      throw Error(ErrorCode::kLimit, fmt::format("accessor {} asks for {} elements without data", i, accessor.count));
    bytes -= accessor.count * elementSize;
  }
  std::uint64_t given = 0;
  for (const tinygltf::Buffer& buffer : model.buffers)
    given += buffer.data.size();
  std::uint64_t viewed = 0;
  for (const tinygltf::BufferView& view : model.bufferViews)
    viewed += view.byteLength;
  if (viewed > kFreeAccessorBytes + kMaxOverlap * given)
    throw Error(ErrorCode::kLimit, fmt::format("buffer views span {} bytes of buffers of {}", viewed, given));
  if (bytes > kFreeAccessorBytes + kMaxOverlap * given)
    throw Error(ErrorCode::kLimit, fmt::format("accessors read {} bytes out of buffers of {}", bytes, given));
}

/// An unsigned integer of `size` bytes.
std::uint32_t unsignedAt(const std::byte* address, std::uint32_t size) {
  std::uint32_t value = 0;
  std::memcpy(&value, address, size);  // little-endian, zero-extended
  return value;
}

void checkSparse(const Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  if (!accessor.sparse.isSparse) return;
  const Elements indices = sparseElements(model, index).indices;
  std::uint64_t lowest = 0;
  for (std::uint64_t i = 0; i < indices.count; ++i) {
    const std::uint64_t value =
        unsignedAt(indices.data + i * indices.stride, static_cast<std::uint32_t>(indices.stride));
    if (value < lowest || value >= accessor.count)
      malformed(fmt::format("accessor {}: sparse indices must ascend and stay in range", index));
    lowest = value + 1;
  }
}

/// Largest component of an accessor of unsigned integers, base and sparse elements alike.
std::uint32_t largestComponent(const Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  const std::uint32_t components = componentCount(accessor.type);
  const std::uint32_t size = componentBytes(accessor.componentType);
  const auto largest = [&](const Elements& elements) {
    std::uint32_t result = 0;
    for (std::uint64_t i = 0; elements.data != nullptr && i < elements.count; ++i)
      for (std::uint32_t c = 0; c < components; ++c)
        result = std::max(result, unsignedAt(elements.data + i * elements.stride + c * size, size));
    return result;
  };
  const std::uint32_t base = largest(baseElements(model, index, std::numeric_limits<std::uint64_t>::max()));
  return accessor.sparse.isSparse ? std::max(base, largest(sparseElements(model, index).values)) : base;
}

bool isUnsigned(int componentType) {
  return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Whether an accessor may hold this attribute, of a vertex or of a morph target. Any component type of
/// KHR_mesh_quantization will do; application specific attributes may be anything.
bool fitsAttribute(const std::string& name, const tinygltf::Accessor& accessor, bool isTarget) {
  const int type = accessor.type;
  if (name.starts_with('_')) return true;
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return false;
  if (name == "POSITION" || name == "NORMAL") return type == TINYGLTF_TYPE_VEC3;
  if (name == "TANGENT") return type == (isTarget ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4);
  if (name.starts_with("TEXCOORD_")) return type == TINYGLTF_TYPE_VEC2;
  if (name.starts_with("COLOR_")) return type == TINYGLTF_TYPE_VEC3 || type == TINYGLTF_TYPE_VEC4;
  if (name.starts_with("JOINTS_"))
    return type == TINYGLTF_TYPE_VEC4 && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                          accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  if (name.starts_with("WEIGHTS_")) return type == TINYGLTF_TYPE_VEC4;
  return true;
}

class MeshCheck {
 public:
  explicit MeshCheck(const Model& model) : model_(model), largest_(model.accessors.size()) {}

  void check(std::size_t mesh) {
    for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives) {
      std::optional<std::uint64_t> vertices;
      checkAttributes(primitive.attributes, mesh, false, vertices);
      for (const auto& target : primitive.targets)
        checkAttributes(target, mesh, true, vertices);
      if (primitive.indices >= 0) checkIndices(primitive.indices, mesh, vertices.value_or(0));
    }
    checkOccluders(mesh);
  }

  /// Joints of a mesh that a node shows with a skin. @param joints  of the skin
  void checkJoints(std::size_t mesh, std::size_t joints) {
    for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives) {
      for (const auto& [name, index] : primitive.attributes) {
        if (name.starts_with("JOINTS_") && largest(index) >= joints)
          malformed(fmt::format("mesh {}: joint {} of {} is out of range, the skin has {}", mesh, largest(index), name,
                                joints));
      }
    }
  }

 private:
  void checkAttributes(const std::map<std::string, int>& attributes, std::size_t mesh, bool isTarget,
                       std::optional<std::uint64_t>& vertices) {
    for (const auto& [name, index] : attributes) {
      const tinygltf::Accessor& accessor = accessorAt(model_, index);
      if (!fitsAttribute(name, accessor, isTarget))
        malformed(fmt::format("mesh {}: accessor {} has the wrong type for {}", mesh, index, name));
      if (vertices.value_or(accessor.count) != accessor.count)
        malformed(fmt::format("mesh {}: attributes of one primitive have {} and {} elements", mesh, *vertices,
                              accessor.count));
      vertices = accessor.count;
      if (name.starts_with("WEIGHTS_") && weights_.insert(index).second) checkWeights(index, mesh);
    }
  }

  void checkOccluders(std::size_t mesh) const {
    const std::vector<Occluder> occluders = meshOccluders(model_.meshes[mesh]);
    if (occluders.empty()) return;
    Aabb bounds;
    for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;
      if (accessorAt(model_, position->second).bufferView < 0) bounds.add(glm::vec3(0.0F));
      glm::vec3 point(0.0F);
      int axis = 0;
      visitComponents(model_, position->second, [&](float coordinate) {
        point[axis] = coordinate;
        axis = (axis + 1) % 3;
        if (axis == 0) bounds.add(point);
      });
    }
    try {
      requireWithin(occluders, bounds);
    } catch (const Error& error) {
      malformed(fmt::format("mesh {}: {}", mesh, error.what()));
    }
  }

  void checkWeights(int index, std::size_t mesh) const {
    visitComponents(model_, index, [&](float weight) {
      if (!(weight >= 0.0F && std::isfinite(weight)))
        malformed(fmt::format("mesh {}: the weight {:g} is negative or not finite", mesh, weight));
    });
  }

  void checkIndices(int index, std::size_t mesh, std::uint64_t vertices) {
    const tinygltf::Accessor& accessor = accessorAt(model_, index);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned(accessor.componentType) || accessor.normalized)
      malformed(fmt::format("mesh {}: accessor {} cannot hold vertex indices", mesh, index));
    const std::uint32_t most = largest(index);
    // The largest number of a type restarts a strip wherever it stands.
    const std::uint32_t restart = 0xFFFFFFFFU >> (32U - 8U * componentBytes(accessor.componentType));
    if (most == restart) malformed(fmt::format("mesh {}: vertex index {} restarts a primitive", mesh, restart));
    if (most >= vertices)
      malformed(fmt::format("mesh {}: vertex index {} is out of range, there are {} vertices", mesh, most, vertices));
  }

  /// @pre the accessor holds unsigned integers
  std::uint32_t largest(int index) {
    std::optional<std::uint32_t>& known = largest_[static_cast<std::size_t>(index)];
    if (!known) known = largestComponent(model_, index);
    return *known;
  }

  const Model& model_;
  std::vector<std::optional<std::uint32_t>> largest_;  ///< per accessor used as indices or joints
  std::set<int> weights_;                              ///< accessors of weights that were checked
};

void checkMeshes(const Model& model) {
  MeshCheck meshes(model);
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    meshes.check(i);
  std::set<std::pair<int, int>> skinned;  // mesh and skin; many nodes may show one pair
  for (const tinygltf::Node& node : model.nodes)
    if (node.skin >= 0 && node.mesh >= 0) skinned.emplace(node.mesh, node.skin);
  for (const auto& [mesh, skin] : skinned)
    meshes.checkJoints(static_cast<std::size_t>(mesh), model.skins[static_cast<std::size_t>(skin)].joints.size());
}

}  // namespace

void validateData(const Model& model, const Limits& limits) {
  checkDemand(model, limits);
  for (std::size_t i = 0; i < model.accessors.size(); ++i)
    checkSparse(model, static_cast<int>(i));
  checkMeshes(model);
  validateMotion(model, limits);
}

}  // namespace jalousie::asset::detail
