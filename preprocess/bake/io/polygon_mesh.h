// What the readers of OBJ, PLY and STL return: polygons in double precision, with objects and materials.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "bake/mesh/triangle_mesh.h"

namespace jalousie::bake {

inline constexpr std::uint32_t kNoIndex = ~0U;

/// A material of an OBJ file, or the texture of a PLY file. Pictures are names of files relative to the input's folder;
/// empty: none.
struct SurfaceMaterial {
  std::string name;
  glm::vec4 baseColor{1.0F};  ///< linear
  glm::vec3 emissive{0.0F};   ///< linear
  double metallic = 0.0;
  double roughness = 1.0;
  bool alphaInPicture = false;  ///< the alpha of the base colour's picture counts
  std::string baseColorPicture;
  std::string emissivePicture;
  std::string normalPicture;
};

struct PolygonMesh {
  /// Indices into positions, uvs and normals.
  struct Corner {
    std::uint32_t position = 0;
    std::uint32_t uv = kNoIndex;
    std::uint32_t normal = kNoIndex;
  };
  struct Face {
    std::uint32_t end = 0;        ///< of its corners; they begin where those of the face before end
    std::uint32_t object = 0;     ///< below objects.size()
    int material = -1;            ///< below materials.size(); -1: none
    std::uint32_t smoothing = 0;  ///< smoothing group; 0: flat, if the mesh has groups
  };
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;                   ///< of any length
  std::vector<glm::vec2> uvs;                       ///< as glTF counts them: v downwards
  std::vector<glm::vec4> colors;                    ///< linear RGBA for each position, or empty
  std::vector<Corner> corners;                      ///< indices in range
  std::vector<Face> faces;                          ///< of at least three corners
  std::vector<std::string> objects{std::string()};  ///< names; empty: that of the file
  std::vector<SurfaceMaterial> materials;
  bool hasSmoothing = false;  ///< the file has smoothing groups
};

/// The triangles of one object with one material. Normals are empty if there are none.
struct SurfacePart {
  int material = -1;
  TriangleMesh mesh;
};

struct SurfaceObject {
  std::string name;
  glm::dvec3 offset{0.0};  ///< to add to all positions
  std::vector<SurfacePart> parts;
};

/// How corners without a normal get one.
enum class NormalRule {
  kNone,    ///< not at all: the part has no normals if one is missing
  kCreases  ///< by smoothing groups; without groups, edges that bend by more than kCreaseDegrees are creases
};
inline constexpr double kCreaseDegrees = 45.0;

/// Triangulates the faces and collects them by object and material; objects without faces are left out. Objects that
/// are far from the origin for their size get an offset, so that single precision is exact enough for them.
/// @pre the indices are in range
std::vector<SurfaceObject> buildObjects(const PolygonMesh& mesh, NormalRule rule);

/// The n - 2 triangles of a polygon as indices of its corners, by ear clipping in the plane of its mean normal. A convex polygon becomes a fan around its first corner.
std::vector<std::uint32_t> triangulate(std::span<const glm::dvec3> polygon);

}  // namespace jalousie::bake
