// A document whose only mesh is compressed with Draco, made with the encoder of the library.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace jalousie::test {

/// A bumpy sheet of 2 n^2 triangles in the box [0, 1] x [0, 1] x [-0.1, 0.1].
struct DracoSheet {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::u8vec4> colors;  ///< 0 to 255 for 0 to 1
  std::vector<glm::uvec3> triangles;
};
DracoSheet dracoSheet(std::uint32_t n);

enum class DracoMethod { kSequential, kEdgebreaker };

/// Unique ids in the stream; none is the index of its attribute.
inline constexpr std::uint32_t kDracoPosition = 7, kDracoNormal = 3, kDracoUv = 12, kDracoColor = 5, kDracoNumber = 9;

/// The stream of a sheet: positions with 14 bits, normals with 12, texture coordinates with 12, colours and the number
/// of each vertex (an unsigned 16-bit integer) without loss.
std::string dracoStream(const DracoSheet& sheet, DracoMethod method);

/// The JSON of a document whose mesh 0 is the sheet, compressed in view 0 of the binary chunk; the accessors have no
/// data. Attribute `_NUMBER` is the number of the vertex in the sheet.
nlohmann::json dracoDocument(const DracoSheet& sheet, const std::string& stream);

}  // namespace jalousie::test
