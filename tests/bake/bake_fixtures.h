// Meshes and files of the bake tests.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/accessor.h"
#include "bake/mesh/combined_mesh.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/wedges.h"
#include "core/error.h"
#include "support/error_code.h"
#include "support/scenes.h"

namespace jalousie::test {

inline std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Positions and normals of a mesh, moved by an offset.
inline tinygltf::Primitive movedPrimitive(tinygltf::Model& model, const asset::Primitive& mesh,
                                          const glm::vec3& offset) {
  std::vector<glm::vec3> positions = mesh.positions;
  for (glm::vec3& p : positions)
    p += offset;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  return primitive;
}

/// Makes a mesh the only one of a model, shown by one node.
inline void showMesh(tinygltf::Model& model, tinygltf::Mesh mesh) {
  model.meshes = {std::move(mesh)};
  model.nodes.resize(1);
  model.nodes[0].mesh = 0;
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
}

inline bake::CombinedMesh combined(const asset::Primitive& source) {
  bake::CombinedMesh mesh;
  mesh.positions = source.positions;
  mesh.indices = source.indices;
  mesh.primitiveOf.assign(source.positions.size(), 0);
  bake::PrimitiveData data;
  data.vertexCount = static_cast<std::uint32_t>(source.positions.size());
  data.attributes = {{"POSITION", 3, {}}, {"NORMAL", 3, {}}};
  for (std::size_t v = 0; v < source.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      data.attributes[0].values.push_back(source.positions[v][k]);
      data.attributes[1].values.push_back(source.normals[v][k]);
    }
  }
  mesh.primitives.push_back(std::move(data));
  return mesh;
}

/// As combined, with TEXCOORD_0.
inline bake::CombinedMesh combinedTextured(const asset::Primitive& source) {
  bake::CombinedMesh mesh = combined(source);
  bake::Attribute uvs{"TEXCOORD_0", 2, {}};
  for (const glm::vec2& uv : source.uvs)
    uvs.values.insert(uvs.values.end(), {uv.x, uv.y});
  mesh.primitives[0].attributes.push_back(std::move(uvs));
  return mesh;
}

inline bake::WedgeMesh wedges(const asset::Primitive& source) {
  return bake::makeWedges(combined(source));
}

/// Every edge is used once in each direction.
inline bool isClosed(const bake::WedgeMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::uint32_t c = 0; c < mesh.corners.size(); ++c)
    ++edges[{mesh.vertexAt(c), mesh.vertexAt(bake::nextCorner(c))}];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

/// Flat square from 0 to 1 in x and y with 2 n^2 triangles, its normal along +z, UV = position.
inline asset::Primitive grid(std::uint32_t n) {
  asset::Primitive mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const glm::vec2 p(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n));
      mesh.positions.emplace_back(p, 0.0F);
      mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
      mesh.uvs.push_back(p);
      if (x == n || y == n) continue;
      const std::uint32_t v = y * (n + 1) + x;
      mesh.indices.insert(mesh.indices.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
    }
  }
  return mesh;
}

/// The same triangles with three vertices of their own each and face normals, as flat-shaded exports have.
inline asset::Primitive flatShaded(const asset::Primitive& source) {
  asset::Primitive flat;
  for (std::size_t t = 0; t < source.indices.size(); t += 3) {
    const glm::vec3 a = source.positions[source.indices[t]];
    const glm::vec3 b = source.positions[source.indices[t + 1]];
    const glm::vec3 c = source.positions[source.indices[t + 2]];
    for (const glm::vec3& p : {a, b, c}) {
      flat.indices.push_back(static_cast<std::uint32_t>(flat.positions.size()));
      flat.positions.push_back(p);
      flat.normals.push_back(glm::normalize(glm::cross(b - a, c - a)));
    }
  }
  return flat;
}

}  // namespace jalousie::test
