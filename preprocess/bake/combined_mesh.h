// All triangle primitives of one glTF mesh as one index buffer, so that they are simplified together and stay joined.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asset/gltf_file.h"

namespace jalousie::bake {

/// One vertex attribute of a primitive as floats.
struct Attribute {
  std::string name;  ///< glTF semantic, e.g. "NORMAL"
  std::uint32_t components = 3;
  std::vector<float> values;  ///< [vertexCount * components]
};

/// A primitive's vertices; POSITION is attributes[0].
struct PrimitiveData {
  std::vector<Attribute> attributes;
  std::uint32_t firstVertex = 0;  ///< of its vertices in CombinedMesh
  std::uint32_t vertexCount = 0;
  std::uint64_t repairedValues = 0;  ///< numbers of attributes that were NaN or infinite and became 0
};

/// Vertices of all primitives in a row; every triangle's corners belong to one primitive.
struct CombinedMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> primitiveOf;  ///< [positions.size()]
  std::vector<PrimitiveData> primitives;
  std::vector<std::uint32_t> indices;
};

/// Why a mesh cannot be baked and is passed through: other modes than triangles, morph targets, no positions. Empty if
/// it can.
std::string unbakeableReason(const tinygltf::Mesh& mesh);

/// Reads a mesh. Bit-identical vertices are shared; positions may be NaN or infinite (see cleanMesh). Errors:
/// kMalformed, kLimit.
CombinedMesh readCombinedMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const asset::Limits& limits);

/// Appends a mesh with the primitives of `source` and the triangles of `combined`, in vertex-cache and fetch order.
/// Primitives that have no triangle left are dropped. @return  index of the new mesh and its number of vertices
struct WrittenMesh {
  int mesh = -1;
  std::uint32_t vertices = 0;
};
WrittenMesh appendLevelMesh(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& combined);

}  // namespace jalousie::bake
