// Accessors: every component type, normalisation, strides, sparse blocks, and what must be refused.
#include "asset/accessor.h"

#include <cstring>
#include <limits>

#include "asset/asset_fixtures.h"

namespace jalousie::asset {
namespace {

using test::codeOf;

constexpr std::uint64_t kAny = 1'000'000;

/// Adds bytes as a view of buffer 0.
template <class T>
int addView(tinygltf::Model& model, const std::vector<T>& values, std::size_t stride = 0) {
  if (model.buffers.empty()) model.buffers.emplace_back();
  auto& data = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = values.size() * sizeof(T);
  view.byteStride = stride;
  data.resize(data.size() + view.byteLength);
  std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int addAccessor(tinygltf::Model& model, int view, int componentType, int type, std::size_t count,
                bool normalized = false) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = count;
  accessor.normalized = normalized;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

template <class T>
int addSparse(tinygltf::Model& model, const std::vector<std::uint16_t>& indices, const std::vector<T>& values,
              std::size_t count) {
  const int accessor = addAccessor(model, -1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, count);
  auto& sparse = model.accessors.back().sparse;
  sparse.isSparse = true;
  sparse.count = static_cast<int>(indices.size());
  sparse.indices = {0, addView(model, indices), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
  sparse.values = {addView(model, values), 0};
  return accessor;
}

TEST(Accessor, FloatsComeBackAsTheyWereAppended) {
  tinygltf::Model model;
  const std::vector<float> scalars = {0.0F, -1.5F, 3.25F};
  const std::vector<glm::vec2> vec2 = {{1, 2}, {3, 4}};
  const std::vector<glm::vec3> vec3 = {{1, 2, 3}, {-4, 5, -6}};
  const std::vector<glm::vec4> vec4 = {{1, 2, 3, 4}};
  const int a = appendScalars(model, scalars, 0);
  const int b = appendVec2(model, vec2, TINYGLTF_TARGET_ARRAY_BUFFER);
  const int c = appendVec3(model, vec3, TINYGLTF_TARGET_ARRAY_BUFFER);
  const int d = appendVec4(model, vec4, TINYGLTF_TARGET_ARRAY_BUFFER);
  EXPECT_EQ(readScalars(model, a, kAny), scalars);
  EXPECT_EQ(readVec2(model, b, kAny), vec2);
  EXPECT_EQ(readVec3(model, c, kAny), vec3);
  EXPECT_EQ(readVec4(model, d, kAny), vec4);
  const auto index = static_cast<std::size_t>(c);
  EXPECT_EQ(model.accessors[index].minValues, (std::vector<double>{-4, 2, -6}));
  EXPECT_EQ(model.accessors[index].maxValues, (std::vector<double>{1, 5, 3}));
}

TEST(Accessor, QuaternionsAreNormalised) {
  tinygltf::Model model;
  const std::vector<glm::quat> values = {glm::quat(2.0F, 0.0F, 0.0F, 0.0F), glm::quat(0.0F, 3.0F, 0.0F, 4.0F)};
  const std::vector<glm::quat> read = readQuaternions(model, appendQuaternions(model, values, 0), kAny);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_FLOAT_EQ(read[0].w, 1.0F);
  EXPECT_FLOAT_EQ(read[1].x, 0.6F);
  EXPECT_FLOAT_EQ(read[1].z, 0.8F);
}

TEST(Accessor, ZeroQuaternionIsMalformed) {
  tinygltf::Model model;
  const int accessor = appendVec4(model, std::vector<glm::vec4>{glm::vec4(0.0F)}, 0);
  EXPECT_EQ(codeOf([&] { readQuaternions(model, accessor, kAny); }), ErrorCode::kMalformed);
}

TEST(Accessor, NormalisedIntegersFollowTheSpecification) {
  tinygltf::Model model;
  const auto scalars = [&](int view, int type, std::size_t count) {
    return readScalars(model, addAccessor(model, view, type, TINYGLTF_TYPE_SCALAR, count, true), kAny);
  };
  EXPECT_EQ(scalars(addView<std::int8_t>(model, {-128, -127, 0, 127}), TINYGLTF_COMPONENT_TYPE_BYTE, 4),
            (std::vector<float>{-1, -1, 0, 1}));
  EXPECT_EQ(scalars(addView<std::uint8_t>(model, {0, 51, 255}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, 3),
            (std::vector<float>{0, 0.2F, 1}));
  EXPECT_EQ(scalars(addView<std::int16_t>(model, {-32768, -32767, 32767}), TINYGLTF_COMPONENT_TYPE_SHORT, 3),
            (std::vector<float>{-1, -1, 1}));
  EXPECT_EQ(scalars(addView<std::uint16_t>(model, {0, 65535}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 2),
            (std::vector<float>{0, 1}));
}

TEST(Accessor, QuantisedPositionsKeepTheirIntegerValues) {
  tinygltf::Model model;
  const int view = addView<std::int16_t>(model, {-300, 2, 7, 0, 32767, -32768, 1, 0}, 8);
  const int accessor = addAccessor(model, view, TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC3, 2);
  EXPECT_EQ(readVec3(model, accessor, kAny), (std::vector<glm::vec3>{{-300, 2, 7}, {32767, -32768, 1}}));
}

TEST(Accessor, StrideAndOffsetPickInterleavedData) {
  tinygltf::Model model;
  const int view = addView<float>(model, {1, 2, 3, 9, 4, 5, 6, 9}, 16);
  const int whole = addAccessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 2);
  EXPECT_EQ(readVec3(model, whole, kAny), (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}}));
  const int moved = addAccessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, 2);
  model.accessors.back().byteOffset = 4;
  EXPECT_EQ(readVec2(model, moved, kAny), (std::vector<glm::vec2>{{2, 3}, {5, 6}}));
}

TEST(Accessor, ColoursOfThreeComponentsGetAlphaOne) {
  tinygltf::Model model;
  const int accessor = appendVec3(model, std::vector<glm::vec3>{{0.25F, 0.5F, 0.75F}}, 0);
  EXPECT_EQ(readVec4(model, accessor, kAny), (std::vector<glm::vec4>{{0.25F, 0.5F, 0.75F, 1.0F}}));
}

TEST(Accessor, WithoutViewIsZeros) {
  tinygltf::Model model;
  const int accessor = addAccessor(model, -1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 3);
  EXPECT_EQ(readVec3(model, accessor, kAny), std::vector<glm::vec3>(3, glm::vec3(0.0F)));
}

TEST(Accessor, SparseReplacesElements) {
  tinygltf::Model model;
  const int accessor = addSparse<float>(model, {1, 3}, {5.0F, 7.0F}, 5);
  EXPECT_EQ(readScalars(model, accessor, kAny), (std::vector<float>{0, 5, 0, 7, 0}));
}

TEST(Accessor, SparseIndicesMustAscendAndStayInRange) {
  tinygltf::Model model;
  const int beyond = addSparse<float>(model, {1, 5}, {5.0F, 7.0F}, 5);
  const int repeated = addSparse<float>(model, {2, 2}, {5.0F, 7.0F}, 5);
  const int descending = addSparse<float>(model, {3, 1}, {5.0F, 7.0F}, 5);
  const int tooMany = addSparse<float>(model, {0, 1, 2}, {5.0F, 7.0F, 9.0F}, 2);
  const int shortValues = addSparse<float>(model, {0, 1}, {5.0F}, 5);
  for (const int accessor : {beyond, repeated, descending, tooMany, shortValues})
    EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kAny); }), ErrorCode::kMalformed) << accessor;
}

TEST(Accessor, IndicesTakeTheSmallestAllowedType) {
  tinygltf::Model model;
  const std::vector<std::uint32_t> small = {0, 65534, 7};
  const std::vector<std::uint32_t> large = {0, 65535, 7};
  const int a = appendIndices(model, small);
  const int b = appendIndices(model, large);
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(a)].componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(b)].componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  EXPECT_EQ(readIndices(model, a, 65535, kAny), small);
  EXPECT_EQ(readIndices(model, b, 65536, kAny), large);
}

TEST(Accessor, IndexBeyondTheVerticesIsMalformed) {
  tinygltf::Model model;
  const int accessor = appendIndices(model, std::vector<std::uint32_t>{0, 1, 3});
  EXPECT_EQ(codeOf([&] { readIndices(model, accessor, 3, kAny); }), ErrorCode::kMalformed);
  EXPECT_EQ(codeOf([&] { readIndices(model, accessor, 4, kAny); }), std::nullopt);
}

TEST(Accessor, FloatIndicesAreMalformed) {
  tinygltf::Model model;
  const int accessor = appendScalars(model, std::vector<float>{0, 1, 2}, 0);
  EXPECT_EQ(codeOf([&] { readIndices(model, accessor, 3, kAny); }), ErrorCode::kMalformed);
}

TEST(Accessor, WrongTypeAndWrongIndexAreMalformed) {
  tinygltf::Model model;
  const int accessor = appendVec2(model, std::vector<glm::vec2>{{1, 2}}, 0);
  EXPECT_EQ(codeOf([&] { readVec3(model, accessor, kAny); }), ErrorCode::kMalformed);
  EXPECT_EQ(codeOf([&] { readVec2(model, 1, kAny); }), ErrorCode::kMalformed);
  EXPECT_EQ(codeOf([&] { readVec2(model, -1, kAny); }), ErrorCode::kMalformed);
}

TEST(Accessor, DoubleAndSignedIntComponentsAreMalformed) {
  tinygltf::Model model;
  const int view = addView<double>(model, {1.0, 2.0});
  for (const int type : {TINYGLTF_COMPONENT_TYPE_DOUBLE, TINYGLTF_COMPONENT_TYPE_INT, 0, 7}) {
    const int accessor = addAccessor(model, view, type, TINYGLTF_TYPE_SCALAR, 1);
    EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kAny); }), ErrorCode::kMalformed) << type;
  }
}

TEST(Accessor, RangeArithmeticDoesNotWrap) {
  tinygltf::Model model;
  const int view = addView<float>(model, {1, 2, 3, 4}, 252);
  constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max();
  const int accessor = addAccessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 2);
  EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kHuge); }), ErrorCode::kMalformed);
  model.accessors[0].count = kHuge / 252 + 2;
  EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kHuge); }), ErrorCode::kMalformed);
  model.accessors[0].count = 1;
  model.accessors[0].byteOffset = kHuge - 3;
  EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kHuge); }), ErrorCode::kMalformed);
  model.accessors[0].byteOffset = 0;
  model.bufferViews[0].byteOffset = kHuge - 7;
  EXPECT_EQ(codeOf([&] { readScalars(model, accessor, kHuge); }), ErrorCode::kMalformed);
}

TEST(Accessor, TheLastElementOfAStrideEndsInItsView) {
  for (const std::size_t floats : {6U, 7U}) {  // the second of two elements starts at 16 bytes and ends at 28
    tinygltf::Model model;
    const int view = addView<float>(model, std::vector<float>(floats, 1.0F), 16);
    const int accessor = addAccessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 2);
    EXPECT_EQ(codeOf([&] { readVec3(model, accessor, kAny); }),
              floats == 6 ? std::optional(ErrorCode::kMalformed) : std::nullopt);
  }
}

TEST(Accessor, TooManyElementsHitTheLimit) {
  tinygltf::Model model;
  const int accessor = addAccessor(model, -1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 0xFFFFFFFFU);
  EXPECT_EQ(codeOf([&] { readVec3(model, accessor, kAny); }), ErrorCode::kLimit);
}

}  // namespace
}  // namespace jalousie::asset
