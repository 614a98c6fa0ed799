// A small baked object: three levels of an octahedron-like ball, off-centre, as jalousie-bake would write it.
#pragma once

#include <vector>

#include "asset/accessor.h"
#include "asset/asset_fixtures.h"
#include "asset/lod_chain.h"
#include "scatter/source_asset.h"

namespace jalousie::test {

/// Appends an octahedron whose faces are split `splits` times, 8 * 4^splits triangles, radius 1, centred on (3, 0, 0).
inline int addBall(tinygltf::Model& model, std::uint32_t splits) {
  std::vector<std::vector<glm::vec3>> faces;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::vec3 x((octant & 1) != 0 ? 1 : -1, 0, 0);
    const glm::vec3 y(0, (octant & 2) != 0 ? 1 : -1, 0);
    const glm::vec3 z(0, 0, (octant & 4) != 0 ? 1 : -1);
    const bool flip = x.x * y.y * z.z < 0;
    faces.push_back({x, flip ? z : y, flip ? y : z});
  }
  for (std::uint32_t split = 0; split < splits; ++split) {
    std::vector<std::vector<glm::vec3>> finer;
    for (const auto& f : faces) {
      const glm::vec3 ab = glm::normalize(f[0] + f[1]);
      const glm::vec3 bc = glm::normalize(f[1] + f[2]);
      const glm::vec3 ca = glm::normalize(f[2] + f[0]);
      finer.insert(finer.end(), {{f[0], ab, ca}, {ab, f[1], bc}, {ca, bc, f[2]}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  for (const auto& face : faces) {
    for (const glm::vec3& corner : face) {
      indices.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(corner + glm::vec3(3, 0, 0));
    }
  }
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, indices);
  primitive.material = 0;
  tinygltf::Mesh mesh;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

/// Chain of 128, 32 and 8 triangles with one material.
inline tinygltf::Model bakedBall() {
  tinygltf::Model model;
  model.materials.emplace_back();
  model.materials[0].name = "clay";
  for (std::uint32_t lod = 0; lod < 3; ++lod) {
    const int mesh = addBall(model, 2 - lod);
    const std::uint32_t triangles = 128U >> (2 * lod);
    asset::setLodInfo(model.meshes[static_cast<std::size_t>(mesh)], {lod, triangles, 3 * triangles, 0.1 * lod});
    addNode(model, mesh);
  }
  asset::setLodChain(model, 0, std::vector<int>{1, 2}, std::vector<float>{0.5F, 0.1F, 0.0F});
  setScene(model, {0});
  return model;
}

}  // namespace jalousie::test
