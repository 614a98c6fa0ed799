// What accessors hold, by the use that is made of them. Each accessor is looked at once, however often it is used.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "asset/accessor_layout.h"
#include "asset/gltf_validate.h"
#include "asset/instancing.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using tinygltf::Model;

/// Bytes of accessors over bytes of buffers: overlap beyond this costs more time than any honest file asks for.
constexpr std::uint64_t kMaxOverlap = 16;
constexpr std::uint64_t kFreeAccessorBytes = 1ULL << 26U;

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

const tinygltf::Accessor& accessorAt(const Model& model, int index) {
  return model.accessors[static_cast<std::size_t>(index)];
}

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

std::uint32_t indexAt(const Elements& elements, int componentType, std::uint64_t i) {
  const std::byte* at = elements.data + i * elements.stride;
  std::uint32_t value = 0;
  std::memcpy(&value, at, componentBytes(componentType));  // little-endian, zero-extended
  return value;
}

void checkSparse(const Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  if (!accessor.sparse.isSparse) return;
  const Elements indices = sparseElements(model, index).indices;
  std::uint64_t lowest = 0;
  for (std::uint64_t i = 0; i < indices.count; ++i) {
    const std::uint64_t value = indexAt(indices, accessor.sparse.indices.componentType, i);
    if (value < lowest || value >= accessor.count)
      malformed(fmt::format("accessor {}: sparse indices must ascend and stay in range", index));
    lowest = value + 1;
  }
}

/// Largest vertex index of an accessor, base and sparse elements alike.
std::uint32_t largestIndex(const Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  const auto largest = [&](const Elements& elements) {
    std::uint32_t result = 0;
    for (std::uint64_t i = 0; elements.data != nullptr && i < elements.count; ++i)
      result = std::max(result, indexAt(elements, accessor.componentType, i));
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

/// Whether an accessor may hold this attribute. Any component type of KHR_mesh_quantization will do; application
/// specific attributes may be anything.
bool fitsAttribute(const std::string& name, const tinygltf::Accessor& accessor) {
  const int type = accessor.type;
  if (name.starts_with('_')) return true;
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return false;
  if (name == "POSITION" || name == "NORMAL") return type == TINYGLTF_TYPE_VEC3;
  if (name == "TANGENT") return type == TINYGLTF_TYPE_VEC4 || type == TINYGLTF_TYPE_VEC3;  // VEC3 in morph targets
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
      checkAttributes(primitive.attributes, mesh, vertices);
      for (const auto& target : primitive.targets)
        checkAttributes(target, mesh, vertices);
      if (primitive.indices >= 0) checkIndices(primitive.indices, mesh, vertices.value_or(0));
    }
  }

 private:
  void checkAttributes(const std::map<std::string, int>& attributes, std::size_t mesh,
                       std::optional<std::uint64_t>& vertices) const {
    for (const auto& [name, index] : attributes) {
      const tinygltf::Accessor& accessor = accessorAt(model_, index);
      if (!fitsAttribute(name, accessor))
        malformed(fmt::format("mesh {}: accessor {} has the wrong type for {}", mesh, index, name));
      if (vertices.value_or(accessor.count) != accessor.count)
        malformed(fmt::format("mesh {}: attributes of one primitive have {} and {} elements", mesh, *vertices,
                              accessor.count));
      vertices = accessor.count;
    }
  }

  void checkIndices(int index, std::size_t mesh, std::uint64_t vertices) {
    const tinygltf::Accessor& accessor = accessorAt(model_, index);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned(accessor.componentType))
      malformed(fmt::format("mesh {}: accessor {} cannot hold vertex indices", mesh, index));
    std::optional<std::uint32_t>& largest = largest_[static_cast<std::size_t>(index)];
    if (!largest) largest = largestIndex(model_, index);
    // The largest number of a type restarts a strip wherever it stands.
    const std::uint32_t restart = 0xFFFFFFFFU >> (32U - 8U * componentBytes(accessor.componentType));
    if (*largest == restart) malformed(fmt::format("mesh {}: vertex index {} restarts a primitive", mesh, restart));
    if (*largest >= vertices)
      malformed(
          fmt::format("mesh {}: vertex index {} is out of range, there are {} vertices", mesh, *largest, vertices));
  }

  const Model& model_;
  std::vector<std::optional<std::uint32_t>> largest_;  ///< per accessor used as indices
};

void checkSkins(const Model& model) {
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& skin = model.skins[i];
    if (skin.inverseBindMatrices < 0) continue;
    const tinygltf::Accessor& matrices = accessorAt(model, skin.inverseBindMatrices);
    if (matrices.type != TINYGLTF_TYPE_MAT4 || matrices.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        matrices.count < skin.joints.size())
      malformed(fmt::format("skin {}: accessor {} does not hold a matrix for each of {} joints", i,
                            skin.inverseBindMatrices, skin.joints.size()));
  }
}

/// Keys of a channel: one value each, three with CUBICSPLINE; weights have one for each morph target.
void checkChannel(const Model& model, const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                  std::size_t index) {
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  const tinygltf::Accessor& input = accessorAt(model, sampler.input);
  const std::uint64_t values = accessorAt(model, sampler.output).count;
  if (input.type != TINYGLTF_TYPE_SCALAR) malformed(fmt::format("animation {}: times are no scalars", index));
  const std::uint64_t keys = input.count * (sampler.interpolation == "CUBICSPLINE" ? 3 : 1);
  const bool fits = channel.target_path == "weights" ? values % keys == 0 : values == keys;
  if (!fits) malformed(fmt::format("animation {}: {} values for {} times", index, values, input.count));
}

/// Counts, types and rotations of EXT_mesh_gpu_instancing, by reading them as the runtime does.
void checkInstances(const Model& model, const Limits& limits) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!model.nodes[i].extensions.contains("EXT_mesh_gpu_instancing")) continue;
    total += readInstances(model, static_cast<int>(i), limits).translations.size();
    if (total > limits.maxInstances)
      throw Error(ErrorCode::kLimit, fmt::format("more than {} instances", limits.maxInstances));
  }
}

}  // namespace

void validateData(const Model& model, const Limits& limits) {
  checkDemand(model, limits);
  for (std::size_t i = 0; i < model.accessors.size(); ++i)
    checkSparse(model, static_cast<int>(i));
  MeshCheck meshes(model);
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    meshes.check(i);
  checkSkins(model);
  checkInstances(model, limits);
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    for (const tinygltf::AnimationChannel& channel : model.animations[i].channels)
      checkChannel(model, model.animations[i], channel, i);
}

}  // namespace jalousie::asset::detail
