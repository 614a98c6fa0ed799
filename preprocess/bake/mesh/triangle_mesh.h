// The indexed triangle mesh that the PLY and OBJ readers return.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace jalousie::bake {

/// Object-space triangles. Attribute vectors have positions.size() elements or none; indices come in threes, in range.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> colors;  ///< linear RGBA
  std::vector<std::uint32_t> indices;
};

}  // namespace jalousie::bake
