// Goes through the elements in the order of the file.
#include "bake/io/ply_reader.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "bake/io/ply_faces.h"
#include "bake/io/ply_header.h"
#include "bake/io/ply_values.h"
#include "bake/io/ply_vertices.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

using ply::Element;
using ply::Encoding;
using ply::FaceBuilder;
using ply::Header;
using ply::Input;
using ply::isFaceProperty;
using ply::isVertexProperty;
using ply::Property;
using ply::readFaces;
using ply::readHeader;
using ply::readStrips;
using ply::readVertices;
using ply::skipProperty;
using ply::slotOf;

void skipElement(Input& input, const Element& element, Encoding encoding) {
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties)
      skipProperty(input, property, encoding);
}

void noteSkipped(const Element& element, Notes& notes) {
  const bool isFaces = element.name == "face" || element.name == "tristrips";
  if (!isFaces && element.name != "vertex" && element.count > 0)
    return notes.add("PLY elements are passed over", element.name);
  for (const Property& property : element.properties) {
    if (element.name == "vertex" && !isVertexProperty(property))
      notes.add("properties of PLY vertices are left out", property.name);
    if (!isFaces || isFaceProperty(property)) continue;
    const bool isColor = slotOf(property.name) >= 8;
    notes.add(isColor ? "colours of PLY faces are left out" : "properties of PLY faces are left out", property.name);
  }
}

/// Reads the vertices of a file whose faces come before them. @param input  at the first element
void readVerticesAhead(Input input, const Header& header, PolygonMesh& mesh) {
  for (const Element& element : header.elements) {
    if (element.name == "vertex") return readVertices(input, element, header.encoding, mesh);
    skipElement(input, element, header.encoding);
  }
}

}  // namespace

PolygonMesh readPly(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes) {
  Input input(bytes, file);
  const Header header = readHeader(input);
  PolygonMesh mesh;
  for (const std::string& picture : header.pictures) {
    mesh.materials.emplace_back();
    mesh.materials.back().name = picture;
    mesh.materials.back().baseColorPicture = picture;
  }
  if (!header.elements.empty() && header.elements.front().name != "vertex") readVerticesAhead(input, header, mesh);
  std::optional<FaceBuilder> faces;
  bool hasFaces = false;
  for (const Element& element : header.elements) {
    noteSkipped(element, notes);
    if (element.name == "vertex" && mesh.positions.empty()) {
      readVertices(input, element, header.encoding, mesh);
      continue;
    }
    hasFaces = hasFaces || ((element.name == "face" || element.name == "tristrips") && element.count > 0);
    if (!faces && hasFaces) faces.emplace(input, mesh, header.pictures.size());
    if (element.name == "face" && faces) {
      readFaces(input, element, header.encoding, *faces);
    } else if (element.name == "tristrips" && faces) {
      readStrips(input, element, header.encoding, *faces);
    } else {
      skipElement(input, element, header.encoding);
    }
  }
  if (faces && faces->passedOver() > 0)
    notes.add("PLY faces of fewer than three corners are left out", fmt::format("{} faces", faces->passedOver()));
  if (faces && faces->tooLarge() > 0)
    notes.add(fmt::format("PLY faces of over {} corners are left out", kMaxPolygonCorners),
              fmt::format("{} faces", faces->tooLarge()));
  if (mesh.faces.empty() && hasFaces)
    input.fail(fmt::format("no face of the PLY file has 3 to {} corners", kMaxPolygonCorners));
  if (mesh.faces.empty())
    throw Error(ErrorCode::kUnsupported, "the PLY file has no faces; point clouds cannot be baked", file);
  return mesh;
}

}  // namespace jalousie::bake
