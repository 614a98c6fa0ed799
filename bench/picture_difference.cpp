// Draws with the software raster of the baker; a light at the eye shades both sides of every surface.
#include "picture_difference.h"

#include <algorithm>
#include <cmath>

#include "asset/image_io.h"
#include "bake/mesh/surface_samples.h"

namespace jalousie::bench {
namespace {

constexpr std::uint32_t kUv = 3;     // floats of a wedge before its texture coordinates
constexpr std::uint32_t kColor = 5;  // and before its colour

double linearFromSrgb(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::uint8_t srgbFromLinear(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055)));
}

std::vector<ImageRgba8> pyramidOf(const ImageRgba8& image) {
  std::vector<ImageRgba8> levels = {image};
  while (levels.back().width > 1 || levels.back().height > 1)
    levels.push_back(asset::resizeImage(levels.back(), std::max(levels.back().width / 2, 1U),
                                        std::max(levels.back().height / 2, 1U)));
  return levels;
}

double samplesPerUnit(const bake::RasterView& view) {
  return static_cast<double>(view.side) / view.radius;
}

}  // namespace

std::array<glm::dvec3, 26> pictureDirections() {
  std::array<glm::dvec3, 26> directions{};
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) directions[count++] = glm::normalize(glm::dvec3(x, y, z));
  return directions;
}

PictureScene::PictureScene(const asset::SceneFile& file, std::size_t lod) : materials_(file.materials) {
  mesh_.slots = {{"NORMAL", 3, 0, bake::AttributeKind::kNormal},
                 {"TEXCOORD_0", 2, kUv, bake::AttributeKind::kUv},
                 {"COLOR_0", 4, kColor, bake::AttributeKind::kColor}};
  mesh_.stride = 9;
  for (const ImageRgba8& image : file.images)
    pyramids_.push_back(pyramidOf(image));
  for (const asset::Instance& instance : file.instances) {
    const std::vector<asset::LodLevel>& levels = file.chains[instance.chain].levels;
    const asset::LodLevel& level = levels[std::min(lod, levels.size() - 1)];
    for (const asset::Primitive& primitive : file.meshes[level.mesh].primitives)
      append(primitive, instance.worldFromObject);
  }
}

void PictureScene::append(const asset::Primitive& primitive, const glm::mat4& worldFromObject) {
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(worldFromObject)));
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const glm::vec3 n = turn * primitive.normals[v];
    const glm::vec2& uv = primitive.uvs[v];
    const glm::vec4& c = primitive.colors[v];
    mesh_.vertexOf.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
    mesh_.positions.emplace_back(worldFromObject * glm::vec4(primitive.positions[v], 1.0F));
    mesh_.attributes.insert(mesh_.attributes.end(), {n.x, n.y, n.z, uv.x, uv.y, c.x, c.y, c.z, c.w});
  }
  const asset::Material& material = materials_[primitive.material];
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    std::array<glm::dvec3, 3> p;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = primitive.indices[i + k];
      mesh_.corners.push_back(first + vertex);
      p[k] = mesh_.positions[first + vertex];
      uv[k] = primitive.uvs[vertex];
    }
    materialOf_.push_back(primitive.material);
    const double area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    const glm::dvec2 a = uv[1] - uv[0];
    const glm::dvec2 b = uv[2] - uv[0];
    double texels = 0.0;
    if (material.baseTexture) {
      const ImageRgba8& image = pyramids_[material.baseTexture->image][0];
      texels = std::abs(a.x * b.y - a.y * b.x) * image.width * image.height;
    }
    texelsPerArea_.push_back(area > 0.0 ? texels / area : 0.0);
  }
}

glm::dvec4 PictureScene::texel(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const {
  const asset::Material& material = materials_[materialOf_[triangle]];
  if (!material.baseTexture) return glm::dvec4(1.0);
  glm::dvec2 uv(0.0);
  for (int k = 0; k < 3; ++k) {
    const float* values = &mesh_.attributes[std::size_t{mesh_.corners[3 * std::size_t{triangle} + k]} * mesh_.stride];
    uv += barycentric[k] * glm::dvec2(values[kUv], values[kUv + 1]);
  }
  const std::vector<ImageRgba8>& pyramid = pyramids_[material.baseTexture->image];
  const double ratio = texelsPerArea_[triangle] / (samplesPerUnit * samplesPerUnit);
  const double level = ratio > 1.0 ? 0.5 * std::log2(ratio) : 0.0;
  const auto most = static_cast<double>(pyramid.size() - 1);
  const ImageRgba8& image = pyramid[static_cast<std::size_t>(std::lround(std::min(level, most)))];
  const auto place = [](double t, std::uint32_t size) {
    const double wrapped = t - std::floor(t);
    return std::min(static_cast<std::uint32_t>(wrapped * size), size - 1);
  };
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return glm::dvec4(1.0);
  const std::uint8_t* pixel = &image.pixels[image.offset(place(uv.x, image.width), place(uv.y, image.height))];
  return {linearFromSrgb(pixel[0] / 255.0), linearFromSrgb(pixel[1] / 255.0), linearFromSrgb(pixel[2] / 255.0),
          pixel[3] / 255.0};
}

glm::dvec4 PictureScene::baseColor(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const {
  glm::dvec4 color(0.0);
  for (int k = 0; k < 3; ++k) {
    const float* values = &mesh_.attributes[std::size_t{mesh_.corners[3 * std::size_t{triangle} + k]} * mesh_.stride];
    color += barycentric[k] * glm::dvec4(values[kColor], values[kColor + 1], values[kColor + 2], values[kColor + 3]);
  }
  return color * glm::dvec4(materials_[materialOf_[triangle]].baseColor) * texel(triangle, barycentric, samplesPerUnit);
}

bool PictureScene::isThere(std::uint32_t triangle, const glm::dvec3& barycentric, double samplesPerUnit) const {
  const asset::Material& material = materials_[materialOf_[triangle]];
  if (material.alphaMode == asset::AlphaMode::kOpaque) return true;
  const double least = material.alphaMode == asset::AlphaMode::kMask ? double{material.alphaCutoff} : 0.5;
  return baseColor(triangle, barycentric, samplesPerUnit).a >= least;
}

ImageRgba8 drawPicture(const PictureScene& scene, const bake::RasterView& view) {
  const double scale = samplesPerUnit(view);
  const std::vector<bake::RasterSample> samples =
      bake::rasterise(scene.mesh(), view, [&](std::uint32_t triangle, const glm::dvec3& barycentric) {
        return scene.isThere(triangle, barycentric, scale);
      });
  ImageRgba8 picture{2 * view.side, 2 * view.side, std::vector<std::uint8_t>(4 * samples.size(), 0)};
  const glm::dvec3 eye = glm::normalize(view.towardsEye);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].triangle == ~0U) continue;
    const glm::dvec4 color = scene.baseColor(samples[i].triangle, glm::dvec3(samples[i].barycentric), scale);
    const double light = 0.2 + 0.8 * std::abs(glm::dot(glm::dvec3(samples[i].normal), eye));
    for (std::size_t k = 0; k < 3; ++k)
      picture.pixels[4 * i + k] = srgbFromLinear(light * color[static_cast<int>(k)]);
    picture.pixels[4 * i + 3] = 255;
  }
  return picture;
}

std::vector<bake::RasterView> fittedViews(const PictureScene& scene, std::uint32_t side) {
  std::vector<bake::RasterView> views;
  for (const glm::dvec3& direction : pictureDirections()) {
    bake::RasterView view;
    view.towardsEye = direction;
    view.side = side;
    bake::fitView(scene.mesh(), view);
    views.push_back(view);
  }
  return views;
}

void PictureDifference::add(const ImageRgba8& reference, const ImageRgba8& other) {
  for (std::size_t i = 0; i < reference.pixels.size(); i += 4) {
    const bool here = reference.pixels[i + 3] != 0;
    const bool there = other.pixels[i + 3] != 0;
    covered += here ? 1U : 0U;
    onlyOne += here != there ? 1U : 0U;
    if (!here || !there) continue;
    ++both;
    int difference = 0;
    for (std::size_t k = 0; k < 3; ++k)
      difference += std::abs(int{reference.pixels[i + k]} - int{other.pixels[i + k]});
    color += difference / (3.0 * 255.0);
  }
}

double PictureDifference::silhouettePercent() const {
  return covered > 0 ? 100.0 * static_cast<double>(onlyOne) / static_cast<double>(covered) : 0.0;
}

double PictureDifference::colorPercent() const {
  return both > 0 ? 100.0 * color / static_cast<double>(both) : 0.0;
}

}  // namespace jalousie::bench
