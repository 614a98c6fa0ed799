// Element sizes and range checks of accessors; no sum or product here can wrap.
#include "asset/accessor_layout.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

/// The indices or the values of a sparse accessor, which are always tightly packed. Nullopt if they exceed the view.
std::optional<Elements> packedElements(std::span<const std::byte> view, int byteOffset, std::uint32_t elementSize,
                                       std::uint64_t count) {
  if (byteOffset < 0 || !fits(view.size(), static_cast<std::uint64_t>(byteOffset), elementSize, elementSize, count))
    return std::nullopt;
  return Elements{view.data() + byteOffset, elementSize, count};
}

}  // namespace

std::uint32_t componentBytes(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::uint32_t componentCount(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
    case TINYGLTF_TYPE_MAT2:
      return 4;
    case TINYGLTF_TYPE_MAT3:
      return 9;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

std::uint32_t elementBytes(int type, int componentType) {
  const std::uint32_t component = componentBytes(componentType);
  const auto columns = [&](std::uint32_t side) { return side * ((side * component + 3U) / 4U * 4U); };
  if (component == 0) return 0;
  if (type == TINYGLTF_TYPE_MAT2) return columns(2);
  if (type == TINYGLTF_TYPE_MAT3) return columns(3);
  return componentCount(type) * component;
}

void requireIndex(int index, std::size_t size, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size)
    malformed(fmt::format("{} {} is out of range, there are {}", what, index, size));
}

std::span<const std::byte> viewBytes(const tinygltf::Model& model, int view) {
  requireIndex(view, model.bufferViews.size(), "buffer view");
  const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<std::size_t>(view)];
  requireIndex(bufferView.buffer, model.buffers.size(), fmt::format("buffer view {}: buffer", view));
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(bufferView.buffer)].data;
  if (bufferView.byteOffset > data.size() || bufferView.byteLength > data.size() - bufferView.byteOffset)
    malformed(fmt::format("buffer view {} reaches outside its buffer of {} bytes", view, data.size()));
  return std::as_bytes(std::span(data).subspan(bufferView.byteOffset, bufferView.byteLength));
}

bool fits(std::uint64_t available, std::uint64_t offset, std::uint64_t stride, std::uint64_t elementSize,
          std::uint64_t count) {
  if (count == 0) return offset <= available;
  if (offset > available || elementSize > available - offset) return false;
  return stride == 0 || count - 1 <= (available - offset - elementSize) / stride;
}

Elements baseElements(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  requireIndex(accessor, model.accessors.size(), "accessor");
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const std::uint32_t size = elementBytes(source.type, source.componentType);
  if (size == 0) malformed(fmt::format("accessor {}: type or component type not allowed", accessor));
  if (source.count == 0) malformed(fmt::format("accessor {} has no elements", accessor));
  const auto checkLimit = [&] {
    if (source.count > maxElements)
      throw Error(ErrorCode::kLimit,
                  fmt::format("accessor {} has {} elements, the limit is {}", accessor, source.count, maxElements));
  };
  if (source.bufferView < 0) {
    checkLimit();
    return {nullptr, size, source.count};
  }

  const std::span<const std::byte> bytes = viewBytes(model, source.bufferView);
  const std::size_t viewStride = model.bufferViews[static_cast<std::size_t>(source.bufferView)].byteStride;
  const std::uint64_t stride = viewStride != 0 ? viewStride : size;
  if (stride < size) malformed(fmt::format("accessor {}: stride below the element size", accessor));
  if (!fits(bytes.size(), source.byteOffset, stride, size, source.count))
    malformed(fmt::format("accessor {} reaches outside its buffer view", accessor));
  checkLimit();
  return {bytes.data() + source.byteOffset, stride, source.count};
}

SparseElements sparseElements(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const auto& sparse = source.sparse;
  if (sparse.count < 1 || static_cast<std::uint64_t>(sparse.count) > source.count)
    malformed(fmt::format("accessor {}: sparse count {} out of range", accessor, sparse.count));
  const int type = sparse.indices.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    malformed(fmt::format("accessor {}: sparse index type not allowed", accessor));
  const auto count = static_cast<std::uint64_t>(sparse.count);
  const std::optional<Elements> indices = packedElements(viewBytes(model, sparse.indices.bufferView),
                                                         sparse.indices.byteOffset, componentBytes(type), count);
  const std::optional<Elements> values =
      packedElements(viewBytes(model, sparse.values.bufferView), sparse.values.byteOffset,
                     elementBytes(source.type, source.componentType), count);
  if (!indices || !values) malformed(fmt::format("accessor {}: sparse data outside its buffer view", accessor));
  return {*indices, *values};
}

}  // namespace jalousie::asset::detail
