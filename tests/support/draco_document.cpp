// Builds Draco's mesh attribute by attribute, vertex k of the sheet being point k.
#include "support/draco_document.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace jalousie::test {
namespace {

using draco::GeometryAttribute;
using nlohmann::json;

template <class T>
void addAttribute(draco::Mesh& mesh, GeometryAttribute::Type type, draco::DataType dataType, std::uint32_t uniqueId,
                  const std::vector<T>& values) {
  constexpr auto kComponents = static_cast<std::uint8_t>(sizeof(T) / (std::is_same_v<T, glm::u8vec4>     ? 1
                                                                      : std::is_same_v<T, std::uint16_t> ? 2
                                                                                                         : 4));
  GeometryAttribute layout;
  layout.Init(type, nullptr, kComponents, dataType, type == GeometryAttribute::COLOR, sizeof(T), 0);
  const int id = mesh.AddAttribute(layout, true, static_cast<std::uint32_t>(values.size()));
  mesh.attribute(id)->set_unique_id(uniqueId);
  for (std::uint32_t k = 0; k < values.size(); ++k)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(k), &values[k]);
}

}  // namespace

DracoSheet dracoSheet(std::uint32_t n) {
  DracoSheet sheet;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n));
      sheet.positions.emplace_back(uv, 0.1F * std::sin(6.0F * uv.x));
      sheet.normals.push_back(glm::normalize(glm::vec3(-0.6F * std::cos(6.0F * uv.x), 0.0F, 1.0F)));
      sheet.uvs.push_back(uv);
      sheet.colors.emplace_back(x % 256, y % 256, 255, 128);
      if (x == n || y == n) continue;
      const std::uint32_t v = y * (n + 1) + x;
      sheet.triangles.emplace_back(v, v + 1, v + n + 2);
      sheet.triangles.emplace_back(v, v + n + 2, v + n + 1);
    }
  }
  return sheet;
}

std::string dracoStream(const DracoSheet& sheet, DracoMethod method) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(sheet.positions.size()));
  for (const glm::uvec3& t : sheet.triangles)
    mesh.AddFace({draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  std::vector<std::uint16_t> numbers(sheet.positions.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = static_cast<std::uint16_t>(k);
  addAttribute(mesh, GeometryAttribute::POSITION, draco::DT_FLOAT32, kDracoPosition, sheet.positions);
  addAttribute(mesh, GeometryAttribute::NORMAL, draco::DT_FLOAT32, kDracoNormal, sheet.normals);
  addAttribute(mesh, GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, kDracoUv, sheet.uvs);
  addAttribute(mesh, GeometryAttribute::COLOR, draco::DT_UINT8, kDracoColor, sheet.colors);
  addAttribute(mesh, GeometryAttribute::GENERIC, draco::DT_UINT16, kDracoNumber, numbers);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method == DracoMethod::kSequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                               : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(GeometryAttribute::POSITION, 14);
  encoder.SetAttributeQuantization(GeometryAttribute::NORMAL, 12);
  encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, 12);
  draco::EncoderBuffer out;
  if (!encoder.EncodeMeshToBuffer(mesh, &out).ok()) throw std::runtime_error("Draco does not encode");
  return {out.data(), out.size()};
}

json dracoDocument(const DracoSheet& sheet, const std::string& stream) {
  const std::size_t count = sheet.positions.size();
  json document = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"extensionsUsed", {"KHR_draco_mesh_compression"}},
      {"extensionsRequired", {"KHR_draco_mesh_compression"}},
      {"buffers", {{{"byteLength", stream.size()}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", stream.size()}}}},
      {"accessors",
       {{{"componentType", 5126}, {"count", count}, {"type", "VEC3"}, {"min", {0, 0, -1}}, {"max", {1, 1, 1}}},
        {{"componentType", 5126}, {"count", count}, {"type", "VEC3"}},
        {{"componentType", 5126}, {"count", count}, {"type", "VEC2"}},
        {{"componentType", 5121}, {"count", count}, {"type", "VEC4"}, {"normalized", true}},
        {{"componentType", 5123}, {"count", count}, {"type", "SCALAR"}},
        {{"componentType", 5123}, {"count", 3 * sheet.triangles.size()}, {"type", "SCALAR"}}}}};
  json primitive = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}, {"_NUMBER", 4}}},
                    {"indices", 5}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes",
                                                            {{"POSITION", kDracoPosition},
                                                             {"NORMAL", kDracoNormal},
                                                             {"TEXCOORD_0", kDracoUv},
                                                             {"COLOR_0", kDracoColor},
                                                             {"_NUMBER", kDracoNumber}}}};
  document["meshes"] = json::array({{{"primitives", json::array({primitive})}}});
  return document;
}

}  // namespace jalousie::test
