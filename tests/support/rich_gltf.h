// A glTF document with everything the readers know, made by code, for tests that damage it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace jalousie::test {

/// JSON and binary chunk of a GLB file. Each array has a view of its own.
class RichGltf {
 public:
  nlohmann::json document;
  std::string binary;

  /// Accessors of single uses, for tests that damage just one.
  int joints = -1, weights = -1, matrices = -1, times = -1, offsets = -1, rotations = -1, splineRotations = -1,
      morphWeights = -1, points = -1, instanceRotations = -1, instanceOffsets = -1;

  RichGltf();

  /// Offset in the binary of an accessor's first byte.
  std::size_t offsetOf(int accessor) const {
    return document["bufferViews"][document["accessors"][static_cast<std::size_t>(accessor)]["bufferView"]
                                       .get<std::size_t>()]["byteOffset"];
  }
  /// Writes over component `component` of an accessor of floats.
  void setFloat(int accessor, std::size_t component, float value) {
    std::memcpy(&binary[offsetOf(accessor) + 4 * component], &value, sizeof value);
  }
  std::string glb() const {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string chunk = binary;
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    std::string out = "glTF";
    const auto word = [&](std::size_t value) {
      const auto small = static_cast<std::uint32_t>(value);
      out.append(reinterpret_cast<const char*>(&small), sizeof small);
    };
    word(2);
    word(28 + text.size() + chunk.size());
    word(text.size());
    out += "JSON" + text;
    word(chunk.size());
    out.append("BIN\0", 4);
    return out + chunk;
  }

 private:
  template <class T>
  int view(const std::vector<T>& values) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}});
    binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    document["buffers"][0]["byteLength"] = binary.size();
    return static_cast<int>(document["bufferViews"].size()) - 1;
  }

  template <class T>
  int add(const char* type, int componentType, std::size_t components, const std::vector<T>& values,
          bool bounds = false) {
    nlohmann::json accessor = {{"bufferView", view(values)},
                               {"componentType", componentType},
                               {"count", values.size() / components},
                               {"type", type}};
    if (bounds) {
      std::vector<T> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components));
      std::vector<T> high = low;
      for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % components] = std::min(low[i % components], values[i]);
        high[i % components] = std::max(high[i % components], values[i]);
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    document["accessors"].push_back(std::move(accessor));
    return static_cast<int>(document["accessors"].size()) - 1;
  }
  int floats(const char* type, std::size_t components, const std::vector<float>& values, bool bounds = false) {
    return add(type, 5126, components, values, bounds);
  }

  void addSheet();
  void addOddMeshes();
  void addNodes();
  void addAnimations();

  int sheetPositions_ = -1, sheetNormals_ = -1, sheetIndices_ = -1, shortPositions_ = -1;
};

/// A wavy sheet of 72 triangles with every attribute, and its parts for the other meshes.
inline void RichGltf::addSheet() {
  constexpr std::uint32_t kSide = 6;
  std::vector<float> positions, normals, tangents, uvs, colors;
  std::vector<std::uint16_t> indices;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      const float u = static_cast<float>(x) / kSide;
      const float v = static_cast<float>(y) / kSide;
      positions.insert(positions.end(), {3.0F * u, 2.0F * v, 0.2F * std::sin(5.0F * u) * std::cos(4.0F * v)});
      normals.insert(normals.end(), {0.0F, 0.0F, 1.0F});
      tangents.insert(tangents.end(), {1.0F, 0.0F, 0.0F, 1.0F});
      uvs.insert(uvs.end(), {u, v});
      colors.insert(colors.end(), {u, v, 0.5F, 1.0F});
      if (x == kSide || y == kSide) continue;
      const auto c = static_cast<std::uint16_t>(y * (kSide + 1) + x);
      for (const unsigned corner : {0U, 1U, kSide + 2, 0U, kSide + 2, kSide + 1})
        indices.push_back(static_cast<std::uint16_t>(c + corner));
    }
  }
  sheetPositions_ = floats("VEC3", 3, positions, true);
  sheetNormals_ = floats("VEC3", 3, normals);
  sheetIndices_ = add("SCALAR", 5123, 1, indices);
  document["meshes"].push_back({{"name", "sheet"},
                                {"primitives",
                                 {{{"attributes",
                                    {{"POSITION", sheetPositions_},
                                     {"NORMAL", sheetNormals_},
                                     {"TANGENT", floats("VEC4", 4, tangents)},
                                     {"TEXCOORD_0", floats("VEC2", 2, uvs)},
                                     {"COLOR_0", floats("VEC4", 4, colors)}}},
                                   {"indices", sheetIndices_},
                                   {"material", 0}}}}});
}

/// A skinned mesh (1), one with morph targets (2), points (3), a strip and a fan (4), a chain (5, 6), sparse (7).
inline void RichGltf::addOddMeshes() {
  const std::vector<float> four = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F};
  shortPositions_ = floats("VEC3", 3, four, true);
  const int fourIndices = add("SCALAR", 5123, 1, std::vector<std::uint16_t>{0, 1, 2, 3});
  const int sixIndices = add("SCALAR", 5123, 1, std::vector<std::uint16_t>{0, 1, 2, 2, 1, 3});
  joints = add("VEC4", 5121, 4, std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
  weights = floats("VEC4", 4, {0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 0.25F, 0.75F, 0, 0, 1, 0, 0, 0});
  const int target = floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, true);
  points = floats("VEC3", 3, {0, 0, 0, 1, 2, 3}, true);
  const auto simple = [&](int indices, int mode) {
    return nlohmann::json{{"attributes", {{"POSITION", shortPositions_}}}, {"indices", indices}, {"mode", mode}};
  };
  nlohmann::json skinned = simple(sixIndices, 4);
  skinned["attributes"]["JOINTS_0"] = joints;
  skinned["attributes"]["WEIGHTS_0"] = weights;
  nlohmann::json morphed = simple(sixIndices, 4);
  morphed["targets"] = {{{"POSITION", target}}, {{"POSITION", target}}};
  document["meshes"].push_back({{"primitives", {skinned}}});
  document["meshes"].push_back({{"primitives", {morphed}}, {"weights", {0.25, 0.5}}});
  document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", points}}}, {"mode", 0}}}}});
  document["meshes"].push_back(
      {{"primitives", {simple(fourIndices, 5), simple(fourIndices, 6), simple(fourIndices, 3)}}});
  for (const int lod : {0, 1})
    document["meshes"].push_back(
        {{"primitives", {simple(sixIndices, 4)}},
         {"extras",
          {{"jalousie",
            {{"format", 1}, {"lod", lod}, {"triangles", 2}, {"vertices", 4}, {"errorObject", 0.1 * lod}}}}}});
  const int sparseIndices = view(std::vector<std::uint16_t>{1, 3});
  const int sparseValues = view(std::vector<float>{2, 0, 0, 2, 2, 0});
  nlohmann::json sparse = document["accessors"][static_cast<std::size_t>(shortPositions_)];
  sparse["max"] = {2, 2, 0};
  sparse["sparse"] = {{"count", 2},
                      {"indices", {{"bufferView", sparseIndices}, {"componentType", 5123}}},
                      {"values", {{"bufferView", sparseValues}}}};
  document["accessors"].push_back(sparse);
  nlohmann::json patched = simple(sixIndices, 4);
  patched["attributes"]["POSITION"] = document["accessors"].size() - 1;
  document["meshes"].push_back({{"primitives", {patched}}});
}

inline void RichGltf::addNodes() {
  matrices = floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,  //
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1});
  instanceOffsets = floats("VEC3", 3, {0, 0, 0, 5, 0, 0, 0, 5, 0}, true);
  instanceRotations = floats("VEC4", 4, {0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
  document["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", matrices}, {"skeleton", 2}}};
  document["cameras"] = nlohmann::json::parse(
      R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}},
          {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0.5, "zfar": 9}}])");
  document["nodes"] = nlohmann::json::parse(
      R"([{"name": "root", "children": [1, 4, 5, 6], "rotation": [0, 0, 0.6, 0.8]},
          {"mesh": 0, "name": "sheet", "translation": [1, 2, 3], "scale": [1, 2, 1]},
          {"children": [3]}, {"translation": [0, 1, 0]},
          {"mesh": 1, "skin": 0},
          {"mesh": 2, "weights": [0.1, 0.2]},
          {"mesh": 3, "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1]},
          {"mesh": 4},
          {"mesh": 5, "extensions": {"MSFT_lod": {"ids": [9]}}, "extras": {"MSFT_screencoverage": [0.5, 0]}},
          {"mesh": 6},
          {"camera": 0, "translation": [0, 0, 9]}, {"camera": 1},
          {"mesh": 7}, {"mesh": 0}])");
  document["nodes"][13]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", instanceOffsets},
                                                                                  {"ROTATION", instanceRotations}};
  document["scenes"] = {{{"nodes", {0, 2, 7, 8, 10, 11, 12, 13}}}};
  document["scene"] = 0;
}

inline void RichGltf::addAnimations() {
  times = floats("SCALAR", 1, {0, 1, 2.5F}, true);
  offsets = floats("VEC3", 3, {0, 0, 9, 1, 0, 9, 2, 1, 9});
  rotations = floats("VEC4", 4, {0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0.6F, 0.8F});
  splineRotations = floats("VEC4", 4, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,  // tangent, value, tangent
                                       0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0,  //
                                       0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
  morphWeights = floats("SCALAR", 1, {0, 1, 0.5F, 0.5F, 1, 0});
  const auto sampler = [&](int output, const char* interpolation) {
    return nlohmann::json{{"input", times}, {"output", output}, {"interpolation", interpolation}};
  };
  document["animations"] = {{{"samplers",
                              {sampler(offsets, "LINEAR"), sampler(rotations, "STEP"),
                               sampler(splineRotations, "CUBICSPLINE"), sampler(morphWeights, "LINEAR")}},
                             {"channels",
                              {{{"sampler", 0}, {"target", {{"node", 10}, {"path", "translation"}}}},
                               {{"sampler", 1}, {"target", {{"node", 1}, {"path", "rotation"}}}},
                               {{"sampler", 2}, {"target", {{"node", 10}, {"path", "rotation"}}}},
                               {{"sampler", 3}, {"target", {{"node", 5}, {"path", "weights"}}}}}}}};
}

inline RichGltf::RichGltf() {
  document = {{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", 0}}}}};
  document["extensionsUsed"] = {"MSFT_lod", "EXT_mesh_gpu_instancing"};
  document["materials"] = nlohmann::json::parse(
      R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 0.5, 1, 1]}}])");
  document["textures"] = nlohmann::json::parse(R"([{"source": 0, "sampler": 0}])");
  document["samplers"] = nlohmann::json::parse(R"([{"magFilter": 9729, "wrapS": 33071}])");
  document["images"] = nlohmann::json::parse(
      R"([{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9)"
      R"(awAAAABJRU5ErkJggg=="}])");
  addSheet();
  addOddMeshes();
  addNodes();
  addAnimations();
}

}  // namespace jalousie::test
