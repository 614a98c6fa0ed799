// What the readers of OBJ, PLY and STL return: polygons in double precision, with objects and materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace jalousie::bake {

inline constexpr std::uint32_t kNoIndex = ~0U;
/// Readers leave larger faces out: ear clipping takes the square of the corners.
inline constexpr std::size_t kMaxPolygonCorners = 4096;

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

/// How corners without a normal get one.
enum class NormalRule {
  kNone,    ///< not at all: the part has no normals if one is missing
  kCreases  ///< by smoothing groups; without groups, edges that bend by more than kCreaseDegrees are creases
};
inline constexpr double kCreaseDegrees = 45.0;

}  // namespace jalousie::bake
