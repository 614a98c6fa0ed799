// Reads the vertices of a PLY file.
#pragma once

#include <string_view>

#include "bake/io/ply_values.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake::ply {

/// Slot that a vertex property fills: position 0-2, normal 3-5, uv 6-7, colour 8-11; -1 if none.
int slotOf(std::string_view name);
/// Whether a property of a vertex is read.
inline bool isVertexProperty(const Property& property) {
  return !property.countType && slotOf(property.name) >= 0;
}

/// Appends positions, and normals, texture coordinates and colours if the element has them. Errors: kMalformed.
void readVertices(Input& input, const Element& element, Encoding encoding, PolygonMesh& mesh);

}  // namespace jalousie::bake::ply
