// How different two scenes look: silhouettes and colours from the 26 directions of a cube's faces, edges and corners.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asset/scene_types.h"
#include "bake/mesh/wedge_mesh.h"
#include "bake/report/software_raster.h"
#include "bake/simplify/slices.h"
#include "core/image.h"

namespace jalousie::bench {

/// Directions towards the eye: every vector of -1, 0 and 1 but (0, 0, 0).
std::array<glm::dvec3, 26> pictureDirections();

/// The triangles of all instances in world space, with what colours them. Every level of a scene is drawn with level
/// `lod` of each chain, or with its last one if it has fewer.
class PictureScene {
 public:
  PictureScene(const asset::SceneFile& file, std::size_t lod);
  const bake::WedgeMesh& mesh() const { return mesh_; }
  /// Base colour with its texture and vertex colours, linear RGB and alpha. @param samplesPerUnit  of the picture;
  /// decides how far the texture is averaged
  glm::dvec4 baseColor(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const;
  /// Whether an alpha mask leaves the point; blended surfaces are there from alpha 0.5.
  bool isThere(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const;

 private:
  void append(const asset::Primitive& primitive, const glm::mat4& worldFromObject);
  glm::dvec4 texel(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const;

  bake::WedgeMesh mesh_;
  std::vector<asset::Material> materials_;
  std::vector<std::uint32_t> materialOf_;          ///< by triangle
  std::vector<double> texelsPerArea_;              ///< by triangle: texels of its texture per square unit
  std::vector<std::vector<ImageRgba8>> pyramids_;  ///< by image: halved until one texel is left
};

/// One picture: per sample the colour in sRGB, 0 to 255; alpha is 255 where the scene is, else 0.
ImageRgba8 drawPicture(const PictureScene& scene, const bake::RasterView& view);

/// Views of a scene from all directions, each fitted to it. @param side  pixels; pictures have twice as many samples
std::vector<bake::RasterView> fittedViews(const PictureScene& scene, std::uint32_t side);

/// Sums over pictures.
struct PictureDifference {
  std::uint64_t covered = 0;  ///< samples of the reference
  std::uint64_t onlyOne = 0;  ///< samples that only one of both covers
  std::uint64_t both = 0;     ///< samples that both cover
  double color = 0.0;         ///< over these the sum of the mean absolute difference of red, green and blue, 0 to 1
  void add(const ImageRgba8& reference, const ImageRgba8& other);
  /// % of the reference's samples
  double silhouettePercent() const;
  /// mean over the samples that both cover, % of the range
  double colorPercent() const;
};

}  // namespace jalousie::bench
