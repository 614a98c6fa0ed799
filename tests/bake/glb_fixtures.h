// GLB files taken apart, changed as JSON and baked, for tests of what a bake keeps.
#pragma once

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/import.h"

namespace jalousie::test {

struct Glb {
  nlohmann::json json;
  std::vector<std::byte> binary;

  /// The bytes of a buffer view.
  std::vector<std::byte> view(std::size_t index) const {
    const nlohmann::json& view = json.at("bufferViews").at(index);
    const auto first = binary.begin() + view.value("byteOffset", std::ptrdiff_t{0});
    return {first, first + view.at("byteLength").get<std::ptrdiff_t>()};
  }
  /// What an accessor reads, with its type: equal for accessors that hold the same.
  std::string accessor(std::size_t index) const {
    const nlohmann::json& accessor = json.at("accessors").at(index);
    std::string text = accessor.at("type").get<std::string>() + std::to_string(accessor.at("componentType").get<int>());
    const std::vector<std::byte> bytes = view(accessor.at("bufferView").get<std::size_t>());
    return text + std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
};

inline Glb splitGlb(const std::vector<std::byte>& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  Glb glb;
  glb.json = nlohmann::json::parse(std::string(reinterpret_cast<const char*>(bytes.data() + 20), length));
  const std::size_t binary = 20 + std::size_t{length} + 8;
  if (binary < bytes.size()) glb.binary.assign(bytes.begin() + static_cast<std::ptrdiff_t>(binary), bytes.end());
  return glb;
}

/// @param buffers  replaces the list of buffers, which is one otherwise
inline std::vector<std::byte> joinGlb(Glb glb, const nlohmann::json& buffers = {}) {
  glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
  glb.json["buffers"] = {{{"byteLength", glb.binary.size()}}};
  if (!buffers.is_null()) glb.json["buffers"] = buffers;
  std::string text = glb.json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> bytes;
  const auto word = [&](std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    const auto* first = reinterpret_cast<const std::byte*>(&number);
    bytes.insert(bytes.end(), first, first + 4);
  };
  for (const std::size_t value : {std::size_t{0x46546C67}, std::size_t{2}, 28 + text.size() + glb.binary.size(),
                                  text.size(), std::size_t{0x4E4F534A}})
    word(value);
  const auto chunk = std::as_bytes(std::span(text.data(), text.size()));
  bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  word(glb.binary.size());
  word(0x004E4942);
  bytes.insert(bytes.end(), glb.binary.begin(), glb.binary.end());
  return bytes;
}

/// Appends bytes in a buffer view of their own. @return  its index
inline std::size_t appendView(Glb& glb, std::span<const std::byte> bytes) {
  glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
  glb.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", bytes.size()}});
  glb.binary.insert(glb.binary.end(), bytes.begin(), bytes.end());
  return glb.json["bufferViews"].size() - 1;
}

template <class Number>
std::size_t appendAccessor(Glb& glb, const std::vector<Number>& values, int componentType, const char* type,
                           std::size_t components) {
  const std::size_t view = appendView(glb, std::as_bytes(std::span(values)));
  glb.json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", values.size() / components}});
  return glb.json["accessors"].size() - 1;
}

/// One node "ball" with one mesh of one primitive.
inline Glb oneMesh(const asset::Primitive& mesh) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  model.meshes.resize(1);
  model.meshes[0].name = "ball";
  model.meshes[0].primitives = {primitive};
  model.nodes.resize(1);
  model.nodes[0].name = "ball";
  model.nodes[0].mesh = 0;
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  return splitGlb(asset::encodeGlb(model));
}

struct BakedGlb {
  Glb glb;
  tinygltf::Model model;  ///< as read back
  std::vector<bake::MeshReport> reports;
};

/// Bakes as the program does.
inline BakedGlb bakeGlb(const Glb& input, std::uint32_t levels = 4) {
  tinygltf::Model model = bake::importBytes(joinGlb(input), "input.glb", {});
  bake::BakeOptions options;
  options.chain.levels = levels;
  options.chain.samples = 1000;
  BakedGlb baked;
  baked.reports = bake::bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
  const std::vector<std::byte> bytes = asset::encodeGlb(std::move(model));
  baked.glb = splitGlb(bytes);
  baked.model = asset::parseGltf(bytes, "output.glb");
  return baked;
}

}  // namespace jalousie::test
