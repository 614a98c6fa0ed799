// Checks every index, and builds the corners of polygons and strips.
#include "bake/io/ply_faces.h"

#include <cmath>
#include <limits>

namespace jalousie::bake::ply {
namespace {

std::uint64_t listLength(Input& input, const Property& property, Encoding encoding) {
  const double count = input.value(*property.countType, encoding);
  if (!(count >= 0.0) || count > static_cast<double>(input.left()))
    input.fail("a PLY face has an impossible number of corners");
  return static_cast<std::uint64_t>(count);
}

std::uint32_t vertexIndex(Input& input, const Property& property, Encoding encoding) {
  const double index = input.value(property.type, encoding);
  if (!(index >= 0.0 && index < std::numeric_limits<std::uint32_t>::max()) || index != std::floor(index))
    input.fail("a PLY face has an index out of range");
  return static_cast<std::uint32_t>(index);
}

bool isIndexList(const Property& property) {
  return property.countType && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void readFace(Input& input, const Element& element, Encoding encoding, PlyFace& face) {
  face.polygon.clear();
  face.uvs.clear();
  face.picture = 0.0;
  for (const Property& property : element.properties) {
    if (isIndexList(property)) {
      const std::uint64_t count = listLength(input, property, encoding);
      face.polygon.clear();
      for (std::uint64_t i = 0; i < count; ++i)
        face.polygon.push_back(vertexIndex(input, property, encoding));
    } else if (property.countType && property.name == "texcoord") {
      const std::uint64_t count = listLength(input, property, encoding);
      for (std::uint64_t i = 0; i < count; ++i)
        face.uvs.push_back(static_cast<float>(input.value(property.type, encoding)));
    } else if (!property.countType && property.name == "texnumber") {
      face.picture = input.value(property.type, encoding);
    } else {
      skipProperty(input, property, encoding);
    }
  }
}

}  // namespace

bool isFaceProperty(const Property& property) {
  return isIndexList(property) || (property.countType ? property.name == "texcoord" : property.name == "texnumber");
}

void readFaces(Input& input, const Element& element, Encoding encoding, FaceBuilder& faces) {
  PlyFace face;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    readFace(input, element, encoding, face);
    faces.add(face);
  }
}

void readStrips(Input& input, const Element& element, Encoding encoding, FaceBuilder& faces) {
  std::vector<std::int64_t> strip;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!isIndexList(property)) {
        skipProperty(input, property, encoding);
        continue;
      }
      const std::uint64_t count = listLength(input, property, encoding);
      strip.clear();
      for (std::uint64_t k = 0; k < count; ++k) {
        const double index = input.value(property.type, encoding);
        if (!(index >= -1.0 && index < std::numeric_limits<std::uint32_t>::max()) || index != std::floor(index))
          input.fail("a PLY strip has an index out of range");
        strip.push_back(static_cast<std::int64_t>(index));
      }
      faces.addStrip(strip);
    }
  }
}

}  // namespace jalousie::bake::ply
