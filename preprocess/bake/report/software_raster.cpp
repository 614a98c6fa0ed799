// Rasterises with edge functions in double precision.
#include "bake/report/software_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bake/mesh/surface_samples.h"

namespace jalousie::bake {
namespace {

/// Axes of a view: right, up, towards the eye.
std::array<glm::dvec3, 3> axesOf(const RasterView& view) {
  const glm::dvec3 back = glm::normalize(view.towardsEye);
  const glm::dvec3 above = std::abs(back.y) > 0.999 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 right = glm::normalize(glm::cross(above, back));
  return {right, glm::cross(back, right), back};
}

double edge(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Per vertex its place in samples, row 0 at the top, and its depth towards the eye.
std::vector<glm::dvec3> project(const WedgeMesh& mesh, const RasterView& view) {
  const double side = 2.0 * view.side;
  const auto [right, up, back] = axesOf(view);
  const double scale = 0.5 * side / view.radius;
  std::vector<glm::dvec3> screen;
  screen.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) {
    const glm::dvec3 d = glm::dvec3(p) - view.center;
    screen.emplace_back(0.5 * side + scale * glm::dot(d, right), 0.5 * side - scale * glm::dot(d, up),
                        glm::dot(d, back));
  }
  return screen;
}

/// Calls a function for the samples that a triangle covers, with their barycentric coordinates. A shared edge may be
/// drawn by both triangles, never by none. @param area  twice that of the triangle, not 0
template <class Draw>
void forSamples(const std::array<glm::dvec3, 3>& p, double area, int side, const Draw& draw) {
  const auto clampPixel = [&](double x) { return static_cast<int>(std::clamp(x, -1.0, side + 1.0)); };
  const int x0 = std::max(0, clampPixel(std::floor(std::min({p[0].x, p[1].x, p[2].x}) - 0.5)));
  const int x1 = std::min(side - 1, clampPixel(std::ceil(std::max({p[0].x, p[1].x, p[2].x}))));
  const int y0 = std::max(0, clampPixel(std::floor(std::min({p[0].y, p[1].y, p[2].y}) - 0.5)));
  const int y1 = std::min(side - 1, clampPixel(std::ceil(std::max({p[0].y, p[1].y, p[2].y}))));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const glm::dvec3 b = glm::dvec3(edge(p[1], p[2], x + 0.5, y + 0.5), edge(p[2], p[0], x + 0.5, y + 0.5),
                                      edge(p[0], p[1], x + 0.5, y + 0.5)) /
                           area;
      if (b.x < 0.0 || b.y < 0.0 || b.z < 0.0) continue;
      draw(static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x), b);
    }
  }
}

std::uint8_t encodeSrgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * s));
}

}  // namespace

void fitView(const WedgeMesh& mesh, RasterView& view) {
  const auto axes = axesOf(view);
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  for (const glm::vec3& p : mesh.positions) {
    const glm::dvec3 q(glm::dot(glm::dvec3(p), axes[0]), glm::dot(glm::dvec3(p), axes[1]),
                       glm::dot(glm::dvec3(p), axes[2]));
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  view.center = middle.x * axes[0] + middle.y * axes[1] + middle.z * axes[2];
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y);
  view.radius = half > 0.0 ? 1.08 * half : 1.0;
}

std::vector<RasterSample> rasterise(const WedgeMesh& mesh, const RasterView& view, const RasterTest& isThere) {
  const int side = 2 * static_cast<int>(view.side);
  std::vector<RasterSample> samples(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const std::vector<glm::dvec3> screen = project(mesh, view);
  const AttributeSlot* normals = mesh.slot("NORMAL");
  for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
    const std::array<glm::dvec3, 3> p = {screen[mesh.vertexAt(3 * std::size_t{t})],
                                         screen[mesh.vertexAt(3 * std::size_t{t} + 1)],
                                         screen[mesh.vertexAt(3 * std::size_t{t} + 2)]};
    const double area = edge(p[0], p[1], p[2].x, p[2].y);
    if (!(std::abs(area) > 1e-12)) continue;
    const double facing = area < 0.0 ? 1.0 : -1.0;  // rows count downwards: front faces run clockwise
    forSamples(p, area, side, [&](std::size_t at, const glm::dvec3& b) {
      RasterSample& sample = samples[at];
      const auto depth = static_cast<float>(b.x * p[0].z + b.y * p[1].z + b.z * p[2].z);
      if ((sample.triangle != ~0U && depth <= sample.depth) || (isThere && !isThere(t, b))) return;
      const glm::dvec3 normal = shadingNormalAt(mesh, normals, t, b);
      sample = {depth, t, positionAt(mesh, t, b), glm::vec3(facing * normal), glm::vec3(b)};
    });
  }
  return samples;
}

ImageRgba8 resolve(const std::vector<RasterSample>& samples, const RasterView& view,
                   const std::function<glm::dvec3(const RasterSample&)>& shade) {
  ImageRgba8 image{view.side, view.side, {}};
  image.pixels.assign(std::size_t{view.side} * view.side * 4, 0);
  for (std::uint32_t y = 0; y < view.side; ++y) {
    for (std::uint32_t x = 0; x < view.side; ++x) {
      glm::dvec3 color(0.0);
      int covered = 0;
      for (std::uint32_t k = 0; k < 4; ++k) {
        const RasterSample& sample = samples[(2 * std::size_t{y} + k / 2) * 2 * view.side + 2 * std::size_t{x} + k % 2];
        if (sample.triangle == ~0U) continue;
        color += shade(sample);
        ++covered;
      }
      if (covered == 0) continue;
      std::uint8_t* pixel = &image.pixels[image.offset(x, y)];
      for (int k = 0; k < 3; ++k)
        pixel[k] = encodeSrgb(color[k] / covered);
      pixel[3] = static_cast<std::uint8_t>(255 * covered / 4);
    }
  }
  return image;
}

glm::dvec3 litBy(const RasterView& view, const glm::vec3& normal, const glm::dvec3& albedo) {
  const auto [right, up, back] = axesOf(view);
  const glm::dvec3 light = glm::normalize(-0.6 * right + 0.8 * up + 0.7 * back);
  const double diffuse = std::max(glm::dot(glm::dvec3(normal), light), 0.0);
  const double fill = 0.5 + 0.5 * glm::dot(glm::dvec3(normal), up);
  return albedo * (0.12 + 0.13 * fill + 0.8 * diffuse);
}

}  // namespace jalousie::bake
