// Triangles first, then normals for each corner, then one vertex for each different corner of a part.
#include "bake/io/surface_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "bake/io/corner_normals.h"
#include "bake/io/triangulate.h"

namespace jalousie::bake {
namespace {

/// Single precision is exact to 2^-24 of a coordinate: beyond this many diagonals that is visible.
constexpr double kFarDiagonals = 16.0;

/// Triangles as indices of the mesh's corners, with the face of each.
struct Triangles {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> faces;
};

Triangles triangulateFaces(const PolygonMesh& mesh) {
  Triangles triangles;
  std::vector<glm::dvec3> polygon;
  std::uint32_t first = 0;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    polygon.clear();
    for (std::uint32_t c = first; c < mesh.faces[f].end; ++c)
      polygon.push_back(mesh.positions[mesh.corners[c].position]);
    for (const std::uint32_t corner : triangulate(polygon))
      triangles.corners.push_back(first + corner);
    triangles.faces.resize(triangles.corners.size() / 3, f);
    first = mesh.faces[f].end;
  }
  return triangles;
}

/// The value in single precision. Not inline: GCC 12 takes the two conversions for none where it vectorises them.
[[gnu::noinline]] double inSinglePrecision(double value) {
  return static_cast<double>(static_cast<float>(value));
}

/// The middle of a box if the box is small for its place, rounded so that it is exact in single precision; else zero.
glm::dvec3 offsetOf(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 middle = 0.5 * (low + high);
  const double away = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
  if (!(away > kFarDiagonals * glm::length(high - low)) || low == high) return glm::dvec3(0.0);
  return {inSinglePrecision(middle.x), inSinglePrecision(middle.y), inSinglePrecision(middle.z)};
}

/// Collects the triangles of one object and material and shares equal corners.
class PartBuilder {
 public:
  PartBuilder(const PolygonMesh& mesh, const CornerNormals& normals, const glm::dvec3& offset)
      : mesh_(mesh), normals_(normals), offset_(offset) {}

  /// @param heads  for each position the last vertex that was made of it, kNoIndex between parts
  void add(std::uint32_t corner, std::uint32_t normal, std::vector<std::uint32_t>& heads) {
    const PolygonMesh::Corner& source = mesh_.corners[corner];
    std::uint32_t vertex = heads[source.position];
    while (vertex != kNoIndex && (vertices_[vertex].uv != source.uv || vertices_[vertex].normal != normal))
      vertex = vertices_[vertex].next;
    if (vertex == kNoIndex) {
      vertex = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back({source.position, source.uv, normal, heads[source.position]});
      heads[source.position] = vertex;
    }
    part_.mesh.indices.push_back(vertex);
  }

  SurfacePart finish(int material, std::vector<std::uint32_t>& heads) {
    TriangleMesh& mesh = part_.mesh;
    bool hasNormals = true;
    bool hasUvs = true;
    for (const Vertex& vertex : vertices_) {
      heads[vertex.position] = kNoIndex;
      hasNormals = hasNormals && vertex.normal != kNoIndex;
      hasUvs = hasUvs && vertex.uv != kNoIndex;
      mesh.positions.emplace_back(mesh_.positions[vertex.position] - offset_);
      if (!mesh_.colors.empty()) mesh.colors.push_back(mesh_.colors[vertex.position]);
    }
    for (const Vertex& vertex : vertices_) {
      if (hasNormals) mesh.normals.push_back(normals_.values[vertex.normal]);
      if (hasUvs) mesh.uvs.push_back(mesh_.uvs[vertex.uv]);
    }
    part_.material = material;
    return std::move(part_);
  }

 private:
  struct Vertex {
    std::uint32_t position, uv, normal, next;
  };
  const PolygonMesh& mesh_;
  const CornerNormals& normals_;
  glm::dvec3 offset_;
  std::vector<Vertex> vertices_;
  SurfacePart part_;
};

/// The triangles of each material of each object.
using Groups = std::map<std::uint32_t, std::map<int, std::vector<std::uint32_t>>>;

struct Extent {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const Extent& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  double diagonal() const { return glm::length(high - low); }
};

Extent extentOf(const PolygonMesh& mesh, const Triangles& triangles,
                const std::map<int, std::vector<std::uint32_t>>& materials) {
  Extent extent;
  for (const auto& [material, list] : materials) {
    for (const std::uint32_t t : list) {
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& p = mesh.positions[mesh.corners[triangles.corners[3 * std::size_t{t} + k]].position];
        extent.add({p, p});
      }
    }
  }
  return extent;
}

/// Objects of one offset keep the vertices that they share equal, bit for bit; so all have that of the file, unless
/// single precision would leave too little of an object.
glm::dvec3 offsetIn(const Extent& file, const Extent& object) {
  constexpr double kLeastShare = 1.0 / 256.0;  // of the file's diagonal: positions keep 16 bits at least
  const bool large = object.diagonal() >= kLeastShare * file.diagonal();
  const glm::dvec3 shared = offsetOf(file.low, file.high);
  return large && shared != glm::dvec3(0.0) ? shared : offsetOf(object.low, object.high);
}

struct ObjectBuilder {
  const PolygonMesh& mesh;
  const Triangles& triangles;
  const CornerNormals& normals;

  /// @param object  with its offset   @param heads  as PartBuilder
  SurfaceObject build(const std::map<int, std::vector<std::uint32_t>>& materials, SurfaceObject object,
                      std::vector<std::uint32_t>& heads) const;
};

SurfaceObject ObjectBuilder::build(const std::map<int, std::vector<std::uint32_t>>& materials, SurfaceObject object,
                                   std::vector<std::uint32_t>& heads) const {
  for (const auto& [material, list] : materials) {
    PartBuilder builder(mesh, normals, object.offset);
    for (const std::uint32_t t : list) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 3 * std::size_t{t} + k;
        builder.add(triangles.corners[at], normals.ofCorner[at], heads);
      }
    }
    object.parts.push_back(builder.finish(material, heads));
  }
  return object;
}

}  // namespace

std::vector<SurfaceObject> buildObjects(const PolygonMesh& mesh, NormalRule rule) {
  const Triangles triangles = triangulateFaces(mesh);
  const CornerNormals normals = cornerNormals(mesh, triangles.corners, triangles.faces, rule);
  Groups groups;
  for (std::uint32_t t = 0; t < triangles.faces.size(); ++t) {
    const PolygonMesh::Face& face = mesh.faces[triangles.faces[t]];
    groups[face.object][face.material].push_back(t);
  }
  std::vector<std::uint32_t> heads(mesh.positions.size(), kNoIndex);
  std::vector<SurfaceObject> objects;
  Extent file;
  for (const auto& [object, materials] : groups)
    file.add(extentOf(mesh, triangles, materials));
  const ObjectBuilder builder{mesh, triangles, normals};
  for (const auto& [number, materials] : groups) {
    SurfaceObject object;
    object.name = mesh.objects[number];
    object.offset = offsetIn(file, extentOf(mesh, triangles, materials));
    objects.push_back(builder.build(materials, std::move(object), heads));
  }
  return objects;
}

}  // namespace jalousie::bake
