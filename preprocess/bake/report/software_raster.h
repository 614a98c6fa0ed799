// A small z-buffered rasteriser for the sheet and for benchmarks: no OpenGL, and the same pixels on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "core/image.h"

namespace jalousie::bake {

/// Parallel view of a sphere: the picture's half side is `radius`, object-space lengths.
struct RasterView {
  glm::dvec3 center{0.0};
  double radius = 1.0;
  glm::dvec3 towardsEye = glm::normalize(glm::dvec3(0.55, 0.35, 1.0));
  std::uint32_t side = 360;  ///< pixels, square
};

/// The nearest surface under each of 2x2 samples per pixel.
struct RasterSample {
  float depth = 0.0F;
  std::uint32_t triangle = ~0U;  ///< ~0: background
  glm::vec3 position{0.0F};      ///< object space
  glm::vec3 normal{0.0F};        ///< unit, shading, of the side that is seen
  glm::vec3 barycentric{0.0F};
};

/// Whether a point of a triangle is there at all: alpha masks make holes.
using RasterTest = std::function<bool(std::uint32_t triangle, const glm::dvec3& barycentric)>;

/// Centres the view on the mesh and fits it with a small margin.
void fitView(const WedgeMesh& mesh, RasterView& view);

/// [2 * side * 2 * side] samples, row 0 at the top. Triangles without area leave no trace.
/// @param isThere  called for samples that would be seen; empty: all points are there
std::vector<RasterSample> rasterise(const WedgeMesh& mesh, const RasterView& view, const RasterTest& isThere = {});

/// Averages shade(sample) over the covered samples of each pixel, alpha from their number.
/// @param shade  linear RGB in [0, 1]
ImageRgba8 resolve(const std::vector<RasterSample>& samples, const RasterView& view,
                   const std::function<glm::dvec3(const RasterSample&)>& shade);

/// Soft light from the upper left on a matt surface of colour `albedo`.
glm::dvec3 litBy(const RasterView& view, const glm::vec3& normal, const glm::dvec3& albedo);

}  // namespace jalousie::bake
