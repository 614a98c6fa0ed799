// Reads the faces and the strips of a PLY file.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/io/ply_values.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake::ply {

/// One face while it is read.
struct PlyFace {
  std::vector<std::uint32_t> polygon;
  std::vector<float> uvs;  ///< two for each corner, or none
  double picture = 0.0;    ///< number of its picture
};

/// Adds faces to a mesh. Attributes of vertices follow the position; texture coordinates of faces replace those.
class FaceBuilder {
 public:
  FaceBuilder(const Input& input, PolygonMesh& mesh, std::size_t pictures)
      : input_(input), mesh_(mesh), pictures_(pictures), vertexUvs_(mesh.uvs.size()) {}

  void add(const PlyFace& face) {
    if (face.polygon.size() < 3) {
      ++passedOver_;
      return;
    }
    if (face.polygon.size() > kMaxPolygonCorners) {
      ++tooLarge_;
      return;
    }
    const bool hasOwnUvs = face.uvs.size() == 2 * face.polygon.size();
    for (std::size_t i = 0; i < face.polygon.size(); ++i) {
      PolygonMesh::Corner corner = cornerOf(face.polygon[i]);
      if (hasOwnUvs) {
        const float u = face.uvs[2 * i];
        const float v = face.uvs[2 * i + 1];
        if (!std::isfinite(u) || !std::isfinite(v)) input_.fail("a PLY texture coordinate is NaN or infinite");
        corner.uv = static_cast<std::uint32_t>(mesh_.uvs.size());
        mesh_.uvs.emplace_back(u, 1.0F - v);
      }
      mesh_.corners.push_back(corner);
    }
    const bool hasPicture = face.picture >= 0.0 && face.picture < static_cast<double>(pictures_);
    finish(hasPicture ? static_cast<int>(face.picture) : -1);
  }

  /// The triangles of strips, which -1 separates: every second one is wound the other way.
  void addStrip(const std::vector<std::int64_t>& strip) {
    std::size_t first = 0;
    for (std::size_t i = 0; i <= strip.size(); ++i) {
      if (i < strip.size() && strip[i] >= 0) continue;
      for (std::size_t k = first; k + 2 < i; ++k) {
        const std::size_t odd = (k - first) % 2;
        for (const std::size_t at : {k, k + 1 + odd, k + 2 - odd})
          mesh_.corners.push_back(cornerOf(static_cast<std::uint32_t>(strip[at])));
        finish(pictures_ > 0 ? 0 : -1);
      }
      first = i + 1;
    }
  }

  /// Faces of fewer than three corners.
  std::size_t passedOver() const { return passedOver_; }
  /// Faces of more than kMaxPolygonCorners.
  std::size_t tooLarge() const { return tooLarge_; }

 private:
  PolygonMesh::Corner cornerOf(std::uint32_t index) const {
    if (index >= mesh_.positions.size()) input_.fail("a PLY face has an index out of range");
    PolygonMesh::Corner corner{index, kNoIndex, kNoIndex};
    if (!mesh_.normals.empty()) corner.normal = index;
    if (vertexUvs_ > 0) corner.uv = index;
    return corner;
  }

  void finish(int material) {
    if (mesh_.corners.size() > 3 * kMaxElements) input_.limit("the PLY file has too many triangles");
    PolygonMesh::Face face;
    face.end = static_cast<std::uint32_t>(mesh_.corners.size());
    face.material = material;
    mesh_.faces.push_back(face);
  }

  const Input& input_;
  PolygonMesh& mesh_;
  std::size_t pictures_;
  std::size_t vertexUvs_;
  std::size_t passedOver_ = 0;
  std::size_t tooLarge_ = 0;
};

/// Whether a property of a face or a strip is read.
bool isFaceProperty(const Property& property);

/// Adds the faces of an element. Errors: kMalformed, kLimit.
void readFaces(Input& input, const Element& element, Encoding encoding, FaceBuilder& faces);
/// Adds the triangles of an element of strips. Errors: kMalformed, kLimit.
void readStrips(Input& input, const Element& element, Encoding encoding, FaceBuilder& faces);

}  // namespace jalousie::bake::ply
