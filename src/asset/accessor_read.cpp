// Reading of accessors: gather the elements into packed bytes, apply the sparse block, convert.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "asset/accessor.h"
#include "asset/accessor_layout.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

using detail::Elements;

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

template <class T>
T load(const std::byte* address) {
  T value;
  std::memcpy(&value, address, sizeof value);
  return value;
}

std::uint32_t loadIndex(const std::byte* address, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(address);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(address);
    default:
      return load<std::uint32_t>(address);
  }
}

/// glTF 2.0, 3.11: the value of a signed normalised integer is max(c / limit, -1).
template <class T>
float normalisedValue(T value) {
  return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

template <class T>
float loadInteger(const std::byte* address, bool normalised) {
  const T value = load<T>(address);
  return normalised ? normalisedValue(value) : static_cast<float>(value);
}

float loadFloat(const std::byte* address, int componentType, bool normalised) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return loadInteger<std::int8_t>(address, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return loadInteger<std::uint8_t>(address, normalised);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return loadInteger<std::int16_t>(address, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return loadInteger<std::uint16_t>(address, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return loadInteger<std::uint32_t>(address, normalised);
    default:
      return load<float>(address);
  }
}

void applySparse(const tinygltf::Model& model, int accessor, std::span<std::byte> packed, std::uint32_t elementSize) {
  const detail::SparseElements sparse = detail::sparseElements(model, accessor);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  std::uint64_t lowest = 0;
  for (std::uint64_t i = 0; i < sparse.indices.count; ++i) {
    const std::uint64_t index =
        loadIndex(sparse.indices.data + i * sparse.indices.stride, source.sparse.indices.componentType);
    if (index < lowest || index >= source.count)
      malformed(fmt::format("accessor {}: sparse indices must ascend and stay in range", accessor));
    lowest = index + 1;
    std::memcpy(packed.data() + index * elementSize, sparse.values.data + i * elementSize, elementSize);
  }
}

/// All elements without gaps, zeros where the accessor has no view.
std::vector<std::byte> packedBytes(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  const Elements elements = detail::baseElements(model, accessor, maxElements);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const std::uint32_t size = detail::elementBytes(source.type, source.componentType);
  std::vector<std::byte> packed(elements.count * size);
  if (elements.data != nullptr) {
    for (std::uint64_t i = 0; i < elements.count; ++i)
      std::memcpy(packed.data() + i * size, elements.data + i * elements.stride, size);
  }
  if (source.sparse.isSparse) applySparse(model, accessor, packed, size);
  return packed;
}

void requireType(const tinygltf::Model& model, int accessor, std::initializer_list<int> types) {
  detail::requireIndex(accessor, model.accessors.size(), "accessor");
  const int type = model.accessors[static_cast<std::size_t>(accessor)].type;
  if (std::find(types.begin(), types.end(), type) == types.end())
    malformed(fmt::format("accessor {} has the wrong type for its use", accessor));
}

/// Reads vectors of Vector::length() components; components beyond the file's keep `fill`.
template <class Vector>
std::vector<Vector> readVectors(const tinygltf::Model& model, int accessor, std::uint64_t maxElements, float fill) {
  const std::vector<std::byte> packed = packedBytes(model, accessor, maxElements);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const std::uint32_t componentSize = detail::componentBytes(source.componentType);
  const auto components = static_cast<int>(detail::componentCount(source.type));
  std::vector<Vector> values(source.count, Vector(fill));
  const std::byte* address = packed.data();
  for (Vector& value : values) {
    for (int c = 0; c < components; ++c, address += componentSize)
      value[c] = loadFloat(address, source.componentType, source.normalized);
  }
  return values;
}

}  // namespace

tinygltf::Model extractElements(const tinygltf::Model& model, int accessor, std::span<const std::uint32_t> elements,
                                std::uint64_t maxElements) {
  Elements base = detail::baseElements(model, accessor, maxElements);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const std::uint32_t size = detail::elementBytes(source.type, source.componentType);
  std::vector<std::byte> packed;
  if (source.sparse.isSparse) {
    packed = packedBytes(model, accessor, maxElements);
    base.data = packed.data();
    base.stride = size;
  }
  tinygltf::Model part;
  part.buffers.emplace_back();
  part.buffers[0].data.resize(elements.size() * size);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i] >= base.count)
      malformed(fmt::format("accessor {}: element {} of {}", accessor, elements[i], base.count));
    if (base.data != nullptr)
      std::memcpy(part.buffers[0].data.data() + i * size, base.data + elements[i] * base.stride, size);
  }
  part.bufferViews.emplace_back();
  part.bufferViews[0].buffer = 0;
  part.bufferViews[0].byteLength = part.buffers[0].data.size();
  part.accessors.emplace_back();
  part.accessors[0].bufferView = 0;
  part.accessors[0].type = source.type;
  part.accessors[0].componentType = source.componentType;
  part.accessors[0].normalized = source.normalized;
  part.accessors[0].count = elements.size();
  return part;
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_SCALAR});
  const std::vector<glm::vec1> vectors = readVectors<glm::vec1>(model, accessor, maxElements, 0.0F);
  std::vector<float> values(vectors.size());
  std::transform(vectors.begin(), vectors.end(), values.begin(), [](const glm::vec1& v) { return v.x; });
  return values;
}

std::vector<glm::vec2> readVec2(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_VEC2});
  return readVectors<glm::vec2>(model, accessor, maxElements, 0.0F);
}

std::vector<glm::vec3> readVec3(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_VEC3});
  return readVectors<glm::vec3>(model, accessor, maxElements, 0.0F);
}

std::vector<glm::vec4> readVec4(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4});
  return readVectors<glm::vec4>(model, accessor, maxElements, 1.0F);
}

std::vector<glm::quat> readQuaternions(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_VEC4});
  const std::vector<glm::vec4> raw = readVectors<glm::vec4>(model, accessor, maxElements, 0.0F);
  std::vector<glm::quat> values;
  values.reserve(raw.size());
  for (const glm::vec4& v : raw) {
    const float length = glm::length(v);
    if (!std::isfinite(length) || !(length > 0.0F))
      malformed(fmt::format("accessor {} holds a quaternion without direction", accessor));
    values.emplace_back(v.w / length, v.x / length, v.y / length, v.z / length);
  }
  return values;
}

void visitComponents(const tinygltf::Model& model, int accessor, const std::function<void(float)>& visit) {
  const Elements base = detail::baseElements(model, accessor, std::numeric_limits<std::uint64_t>::max());
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const std::uint32_t size = detail::elementBytes(source.type, source.componentType);
  const std::uint32_t componentSize = detail::componentBytes(source.componentType);
  const std::uint32_t components = detail::componentCount(source.type);
  const std::uint32_t rows = source.type == TINYGLTF_TYPE_MAT2 ? 2 : source.type == TINYGLTF_TYPE_MAT3 ? 3 : components;
  const std::uint32_t columnBytes = size / (components / rows);
  const auto visitAll = [&](const Elements& elements) {
    for (std::uint64_t i = 0; elements.data != nullptr && i < elements.count; ++i)
      for (std::uint32_t c = 0; c < components; ++c)
        visit(loadFloat(elements.data + i * elements.stride + c / rows * columnBytes + c % rows * componentSize,
                        source.componentType, source.normalized));
  };
  visitAll(base);
  if (source.sparse.isSparse) visitAll(detail::sparseElements(model, accessor).values);
}

bool holdsFiniteNumbers(const tinygltf::Model& model, int accessor) {
  bool finite = true;
  visitComponents(model, accessor, [&](float value) { finite = finite && std::isfinite(value); });
  return finite;
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, std::uint32_t vertexCount,
                                       std::uint64_t maxElements) {
  requireType(model, accessor, {TINYGLTF_TYPE_SCALAR});
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const bool unsignedType = source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                            source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!unsignedType || source.normalized) malformed(fmt::format("accessor {} cannot hold indices", accessor));
  const std::vector<std::byte> packed = packedBytes(model, accessor, maxElements);
  const std::uint32_t size = detail::componentBytes(source.componentType);
  std::vector<std::uint32_t> values(source.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = loadIndex(packed.data() + i * size, source.componentType);
    if (values[i] >= vertexCount)
      malformed(fmt::format("accessor {}: index {} of {} vertices", accessor, values[i], vertexCount));
  }
  return values;
}

}  // namespace jalousie::asset
