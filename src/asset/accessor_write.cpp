// Appending of vectors to buffer 0 as accessors.
#include <algorithm>
#include <bit>
#include <cstring>

#include "asset/accessor.h"
#include "core/check.h"

namespace jalousie::asset {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

}  // namespace

int appendView(tinygltf::Model& model, std::span<const std::byte> bytes, int target, std::size_t stride) {
  if (model.buffers.empty()) model.buffers.emplace_back();
  std::vector<unsigned char>& data = model.buffers[0].data;
  data.resize((data.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.byteStride = stride;
  view.target = target;
  data.resize(data.size() + bytes.size());
  std::memcpy(data.data() + view.byteOffset, bytes.data(), bytes.size());
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size()) - 1;
}

namespace {

/// How an accessor reads its view: TINYGLTF_TYPE_... and TINYGLTF_COMPONENT_TYPE_...
struct Layout {
  int type;
  int componentType;
};

int appendAccessor(tinygltf::Model& model, std::span<const std::byte> bytes, std::size_t count, Layout layout,
                   int target) {
  JAL_CHECK(count > std::size_t{0});
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, bytes, target);
  accessor.componentType = layout.componentType;
  accessor.type = layout.type;
  accessor.count = count;
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

template <class Vector>
int appendFloats(tinygltf::Model& model, std::span<const Vector> values, int type, int target) {
  return appendAccessor(model, std::as_bytes(values), values.size(), {type, TINYGLTF_COMPONENT_TYPE_FLOAT}, target);
}

}  // namespace

int appendScalars(tinygltf::Model& model, std::span<const float> values, int target) {
  const int index = appendFloats(model, values, TINYGLTF_TYPE_SCALAR, target);
  // Animation inputs must state their range; elsewhere it does no harm.
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  accessor.minValues = {static_cast<double>(*low)};
  accessor.maxValues = {static_cast<double>(*high)};
  return index;
}

int appendVec2(tinygltf::Model& model, std::span<const glm::vec2> values, int target) {
  return appendFloats(model, values, TINYGLTF_TYPE_VEC2, target);
}

int appendVec3(tinygltf::Model& model, std::span<const glm::vec3> values, int target) {
  const int index = appendFloats(model, values, TINYGLTF_TYPE_VEC3, target);
  glm::vec3 low = values[0];
  glm::vec3 high = values[0];
  for (const glm::vec3& value : values) {
    low = glm::min(low, value);
    high = glm::max(high, value);
  }
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  accessor.minValues = {low.x, low.y, low.z};
  accessor.maxValues = {high.x, high.y, high.z};
  return index;
}

int appendVec4(tinygltf::Model& model, std::span<const glm::vec4> values, int target) {
  return appendFloats(model, values, TINYGLTF_TYPE_VEC4, target);
}

int appendQuaternions(tinygltf::Model& model, std::span<const glm::quat> values, int target) {
  std::vector<glm::vec4> vectors(values.size());
  std::transform(values.begin(), values.end(), vectors.begin(),
                 [](const glm::quat& q) { return glm::vec4(q.x, q.y, q.z, q.w); });
  return appendVec4(model, vectors, target);
}

int appendIndices(tinygltf::Model& model, std::span<const std::uint32_t> values) {
  constexpr int kTarget = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  const bool small = std::all_of(values.begin(), values.end(), [](std::uint32_t v) { return v < 65535U; });
  if (!small)
    return appendAccessor(model, std::as_bytes(values), values.size(),
                          {TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}, kTarget);
  std::vector<std::uint16_t> shorts(values.size());
  std::transform(values.begin(), values.end(), shorts.begin(),
                 [](std::uint32_t v) { return static_cast<std::uint16_t>(v); });
  return appendAccessor(model, std::as_bytes(std::span<const std::uint16_t>(shorts)), shorts.size(),
                        {TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}, kTarget);
}

}  // namespace jalousie::asset
