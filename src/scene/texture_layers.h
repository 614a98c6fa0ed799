// Textures as layers of a few array textures, so that one draw call can use them all.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asset/image_io.h"
#include "core/image.h"
#include "core/shared_vector.h"
#include "shared/limits.h"

namespace jalousie::scene {

/// Longest side of a layer, pixels; larger images are resampled to it. All OpenGL 4.5 drivers have it.
inline constexpr std::uint32_t kMaxLayerSide = 16384;

/// What the layer of an image is made for.
struct LayerUse {
  std::optional<float> alphaCutoff = std::nullopt;  ///< of a masked material, for makeMipLevels
  bool isData = false;     ///< normals: stored so that the sRGB decoding of the sampler gives the bytes / 255
  bool isNearest = false;  ///< enlarged without filtering

  friend bool operator==(const LayerUse&, const LayerUse&) = default;
};

/// Layers of one size: an array texture. Both sides are powers of two.
struct TextureClass {
  std::uint32_t width = 1;  ///< pixels
  std::uint32_t height = 1;
  std::uint32_t layers = 0;

  std::uint64_t layerTexels() const { return std::uint64_t{width} * height; }
  std::uint64_t texels() const { return layerTexels() * layers; }
};

/// Where an image lies.
struct TextureSlot {
  std::uint32_t textureClass = 0;  ///< index into TextureLayout::classes
  std::uint32_t layer = 0;
};

/// Classes and places of all images.
struct TextureLayout {
  std::vector<TextureClass> classes;  ///< at most kTextureClasses, the largest layers first
  std::vector<TextureSlot> slots;     ///< per image
};

/// Sorts images into classes. The size that an image needs is the next power of two of each side, at most maxSide.
/// Classes are merged, the pair first that adds the fewest texels, while there are more than gpu::kTextureClasses, and
/// while all layers together have at most 5/4 of the texels that the images need: fewer classes are fewer fetches per
/// fragment (docs/decisions/0013-texture-classes.md).
TextureLayout layoutTextures(std::span<const asset::ImageSize> images, std::uint32_t maxSide = kMaxLayerSide);

/// Images and where they lie. Layers are made one at a time by makeLayer.
struct TextureLayers {
  TextureLayout layout;
  SharedVector<ImageRgba8> images;  ///< as read; may be emptied when the layers are uploaded
  std::vector<LayerUse> uses;       ///< per image
};

/// Mip levels of an image whose sides are powers of two, level 0 first, down to one texel. A side of one texel stays.
/// Colours are averaged in linear light and weighted by alpha, so that the colours of transparent texels do not bleed
/// in.
/// @param alphaCutoff  if given, every level keeps the share of texels whose alpha reaches the cutoff; plain averages
/// would make distant leaves vanish
std::vector<ImageRgba8> makeMipLevels(const ImageRgba8& image, std::optional<float> alphaCutoff);

/// Share of texels with alpha >= cutoff.
float alphaCoverage(const ImageRgba8& image, float cutoff);

/// @param uses  per image; may be shorter than images
TextureLayers makeTextureLayers(const SharedVector<ImageRgba8>& images, const std::vector<LayerUse>& uses = {},
                                std::uint32_t maxSide = kMaxLayerSide);

/// The layer of one image with its mip levels, resampled to the size of its class.
std::vector<ImageRgba8> makeLayer(const TextureLayers& textures, std::size_t image);

}  // namespace jalousie::scene
