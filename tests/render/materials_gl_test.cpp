// What a material shows beside its base colour: samplers, texture coordinates, emission, normals of a texture.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "core/random.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"

namespace jalousie::render {
namespace {

using asset::Mip;
using asset::Sampling;
using asset::Wrap;

constexpr std::uint32_t kSide = 64;  // pixels

class MaterialsGl : public test::GlTest {};

/// A square from -1 to 1 at z = 0 with its corners' texture coordinates.
/// @param low, high  coordinates at the lower left and the upper right corner
asset::Primitive square(const glm::vec2& low, const glm::vec2& high, bool second) {
  asset::Primitive primitive;
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 corner(i & 1, i >> 1);
    primitive.positions.emplace_back(2.0F * corner - 1.0F, 0.0F);
    primitive.normals.emplace_back(0.0F, 0.0F, 1.0F);
    (second ? primitive.uvs1 : primitive.uvs).push_back(glm::mix(low, high, corner));
    (second ? primitive.uvs : primitive.uvs1).emplace_back(7.0F, 7.0F);
    primitive.colors.emplace_back(1.0F);
  }
  if (!second) primitive.uvs1.clear();
  primitive.indices = {0, 1, 3, 0, 3, 2};
  return primitive;
}

asset::SceneFile oneMesh(const asset::Material& material, const asset::Primitive& primitive,
                         const std::vector<ImageRgba8>& images) {
  asset::SceneFile file;
  for (const ImageRgba8& image : images)
    file.images.edit().push_back(image);
  file.materials.push_back(material);
  file.meshes.push_back({"square", {primitive}});
  file.chains.push_back({"square", {{0, 0.0F}}});
  file.instances.push_back({0, glm::mat4(1.0F)});
  return file;
}

/// The square fills the picture exactly. @param behind  seen from its back
ImageRgba8 draw(const asset::SceneFile& file, bool behind = false) {
  const scene::SceneData scene = scene::buildScene(file);
  FrameRenderer renderer(scene, kSide, kSide);
  scene::Camera camera = scene::lookAt({0, 0, behind ? -1 : 1}, {0, 0, 0}, scene.boundsWorld);
  camera.fovY = glm::half_pi<float>();
  camera.zNear = 0.01F;
  FrameOptions options;
  options.cullMode = CullMode::kFrustum;
  options.lodRule = LodRule::kFinest;
  renderer.render(options, camera, camera);
  return renderer.readImage();
}

double linearFromSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

/// Index of the texel behind the borders of an image.
int wrappedTexel(int texel, int count, Wrap wrap) {
  if (wrap == Wrap::kClamp) return std::clamp(texel, 0, count - 1);
  const int period = wrap == Wrap::kMirror ? 2 * count : count;
  const int inside = ((texel % period) + period) % period;
  return inside < count ? inside : 2 * count - 1 - inside;
}

double texelOf(const ImageRgba8& image, const Sampling& sampling, const glm::ivec2& texel, std::size_t channel) {
  const int x = wrappedTexel(texel.x, static_cast<int>(image.width), sampling.wrapU);
  const int y = wrappedTexel(texel.y, static_cast<int>(image.height), sampling.wrapV);
  const std::size_t at = image.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  return linearFromSrgb(image.pixels[at + channel] / 255.0);
}

/// The colour, 0 to 255, that a magnified texture has by the rules of OpenGL 4.5, 8.14.
double magnified(const ImageRgba8& image, const Sampling& sampling, const glm::dvec2& uv, std::size_t channel) {
  const glm::dvec2 at = uv * glm::dvec2(image.width, image.height);
  if (sampling.magnifyNearest)
    return 255.0 * srgbFromLinear(texelOf(image, sampling, glm::ivec2(glm::floor(at)), channel));
  const glm::dvec2 low = glm::floor(at - 0.5);
  const glm::dvec2 share = at - 0.5 - low;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 corner(i & 1, i >> 1);
    const double weight = (corner.x != 0 ? share.x : 1.0 - share.x) * (corner.y != 0 ? share.y : 1.0 - share.y);
    sum += weight * texelOf(image, sampling, glm::ivec2(low) + corner, channel);
  }
  return 255.0 * srgbFromLinear(sum);
}

ImageRgba8 randomImage(std::uint32_t width, std::uint32_t height) {
  Random random(7);
  ImageRgba8 image{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) image.pixels[i] = static_cast<std::uint8_t>(random.below(256));
  return image;
}

/// Largest difference of a drawn square from `magnified`, with coordinates from -1.2 to 2.1 in u and -0.7 to 1.9 in v.
double worstError(const Sampling& sampling, std::uint32_t uvSet) {
  const ImageRgba8 image = randomImage(4, 8);
  const glm::vec2 low(-1.2F, -0.7F);
  const glm::vec2 high(2.1F, 1.9F);
  asset::Material material;
  material.isUnlit = true;
  material.baseTexture.emplace();
  material.baseTexture->sampling = sampling;
  material.baseTexture->uvSet = uvSet;
  const ImageRgba8 picture = draw(oneMesh(material, square(low, high, uvSet == 1), {image}));
  double worst = 0.0;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const glm::dvec2 share((x + 0.5) / kSide, 1.0 - (y + 0.5) / kSide);
        const double expected = magnified(image, sampling, glm::mix(glm::dvec2(low), glm::dvec2(high), share), channel);
        worst = std::max(worst, std::abs(expected - picture.pixels[picture.offset(x, y) + channel]));
      }
  return worst;
}

TEST_F(MaterialsGl, WrapModesAndFiltersOfMagnifiedTexturesMatchTheReference) {
  for (const Wrap u : {Wrap::kRepeat, Wrap::kClamp, Wrap::kMirror})
    for (const Wrap v : {Wrap::kRepeat, Wrap::kClamp, Wrap::kMirror})
      for (const bool nearest : {false, true})
        EXPECT_LT(worstError({u, v, nearest, false, Mip::kLinear}, 0), 3.0)
            << static_cast<int>(u) << ' ' << static_cast<int>(v) << (nearest ? " nearest" : " linear");
}

TEST_F(MaterialsGl, TheSecondTextureCoordinatesAreUsed) {
  EXPECT_LT(worstError({Wrap::kClamp, Wrap::kMirror, true, false, Mip::kLinear}, 1), 2.0);
}

TEST_F(MaterialsGl, MinifiedTexturesKeepToTheirMipLevels) {
  // 64 x 64 texels, one in two white, on 16 x 16 pixels: the mean is grey, single texels are black or white.
  ImageRgba8 image{256, 256, std::vector<std::uint8_t>(std::size_t{4} * 256 * 256, 255)};
  for (std::uint32_t y = 0; y < 256; ++y)
    for (std::uint32_t x = 0; x < 256; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        image.pixels[image.offset(x, y) + c] = ((x ^ y) & 1U) != 0 ? 255 : 0;
  const auto greys = [&](const Sampling& sampling) {
    asset::Material material;
    material.isUnlit = true;
    material.baseTexture.emplace().sampling = sampling;
    const ImageRgba8 picture = draw(oneMesh(material, square({0, 0}, {1.003F, 1.001F}, false), {image}));
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
      count += picture.pixels[i] > 150 && picture.pixels[i] < 220 ? 1 : 0;
    return static_cast<double>(count) / (kSide * kSide);
  };
  EXPECT_GT(greys({Wrap::kRepeat, Wrap::kRepeat, false, false, Mip::kLinear}), 0.99);
  EXPECT_GT(greys({Wrap::kRepeat, Wrap::kRepeat, false, true, Mip::kNearest}), 0.99);
  EXPECT_LT(greys({Wrap::kRepeat, Wrap::kRepeat, false, true, Mip::kNone}), 0.01);
}

TEST_F(MaterialsGl, TransformsMoveTheTexture) {
  const ImageRgba8 image = randomImage(4, 4);
  asset::Material material;
  material.isUnlit = true;
  material.baseTexture.emplace().sampling.magnifyNearest = true;
  material.baseTexture->uvAxes = {0.0F, -2.0F, 4.0F, 0.0F};
  material.baseTexture->uvOffset = {0.25F, 0.5F};
  const ImageRgba8 moved = draw(oneMesh(material, square({0, 0}, {1, 1}, false), {image}));
  asset::Primitive placed = square({0, 0}, {1, 1}, false);
  for (glm::vec2& uv : placed.uvs)
    uv = {4.0F * uv.y + 0.25F, -2.0F * uv.x + 0.5F};
  material.baseTexture->uvAxes = {1.0F, 0.0F, 0.0F, 1.0F};
  material.baseTexture->uvOffset = {0.0F, 0.0F};
  EXPECT_EQ(moved.pixels, draw(oneMesh(material, placed, {image})).pixels);
}

TEST_F(MaterialsGl, ATexturesNormalsAreThoseOfTiltedVertices) {
  const glm::vec3 tilted = glm::normalize(glm::vec3(0.5F, -0.3F, 0.8F));
  ImageRgba8 image{2, 2, std::vector<std::uint8_t>(16, 255)};
  for (std::size_t i = 0; i < 16; ++i)
    if (i % 4 != 3) image.pixels[i] = static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * tilted[i % 4]));
  asset::Material plain;
  plain.baseColor = {0.6F, 0.5F, 0.4F, 1.0F};
  plain.doubleSided = true;
  asset::Material mapped = plain;
  mapped.normalTexture.emplace();
  // u grows to the right, v downwards as in files: +y of the texture points up.
  const asset::Primitive flat = square({0, 1}, {1, 0}, false);
  asset::Primitive bent = flat;
  std::fill(bent.normals.begin(), bent.normals.end(), tilted);
  for (const bool behind : {false, true})
    for (const bool mirrored : {false, true}) {
      asset::SceneFile expected = oneMesh(plain, bent, {});
      asset::SceneFile actual = oneMesh(mapped, flat, {image});
      if (mirrored)
        for (asset::SceneFile* file : {&expected, &actual})
          file->instances[0].worldFromObject[0][0] = -1.0F;
      const ImageRgba8 a = draw(expected, behind);
      const ImageRgba8 b = draw(actual, behind);
      int worst = 0;
      for (std::size_t i = 0; i < a.pixels.size(); ++i)
        worst = std::max(worst, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
      EXPECT_LE(worst, 3) << (behind ? "behind" : "in front") << (mirrored ? ", mirrored" : "");
    }
}

TEST_F(MaterialsGl, EmissionIsAddedAndUnlitColoursAreKept) {
  const ImageRgba8 half{1, 1, {188, 188, 188, 255}};  // linear 0.5
  asset::Material dark;
  dark.baseColor = {0.0F, 0.0F, 0.0F, 1.0F};
  asset::Material glowing = dark;
  glowing.emission = {0.8F, 0.4F, 0.0F};
  glowing.emissiveTexture.emplace();
  const asset::Primitive flat = square({0, 0}, {1, 1}, false);
  const ImageRgba8 without = draw(oneMesh(dark, flat, {}));
  const ImageRgba8 with = draw(oneMesh(glowing, flat, {half}));
  const std::size_t center = with.offset(kSide / 2, kSide / 2);
  for (std::size_t c = 0; c < 3; ++c) {
    // Both are 1 - exp(-1.15 light), encoded as sRGB.
    const auto lightOf = [](std::uint8_t byte) { return -std::log(1.0 - linearFromSrgb(byte / 255.0)) / 1.15; };
    const double expected = 0.5 * static_cast<double>(glowing.emission[static_cast<glm::length_t>(c)]);
    EXPECT_NEAR(lightOf(with.pixels[center + c]) - lightOf(without.pixels[center + c]), expected, 0.015) << c;
  }
  asset::Material unlit;
  unlit.isUnlit = true;
  unlit.baseColor = {0.5F, 0.25F, 1.0F, 1.0F};
  const ImageRgba8 kept = draw(oneMesh(unlit, flat, {}));
  const std::array<int, 3> expected = {188, 137, 255};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(kept.pixels[center + c], expected[c], 1) << c;
}

}  // namespace
}  // namespace jalousie::render
