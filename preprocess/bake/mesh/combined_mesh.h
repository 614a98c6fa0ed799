// All triangle primitives of one glTF mesh in one index buffer: they are simplified together, so no cracks open.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

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
  std::uint32_t source = 0;          ///< the glTF primitive it comes from; several may come from one
  std::uint64_t repairedValues = 0;  ///< numbers of attributes that were NaN or infinite and became 0
};

/// Vertices of all primitives in a row; every triangle's corners belong to one primitive.
struct CombinedMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> primitiveOf;  ///< [positions.size()]
  std::vector<PrimitiveData> primitives;
  std::vector<std::uint32_t> sourceVertex;  ///< [positions.size()] its index in the glTF primitive; empty: not needed
  std::vector<std::uint32_t> indices;
};

}  // namespace jalousie::bake
