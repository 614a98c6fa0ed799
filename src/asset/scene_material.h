// Conversion of glTF materials, as far as they are drawn.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// A texture of a material, before its picture is decoded.
struct TextureReference {
  int image = 0;        ///< index into Model::images
  bool isData = false;  ///< normals, not colours
  TextureUse use;       ///< without its image
};

/// The textures of a material that are drawn. A texture is left out if it has no picture, or takes texture coordinates
/// other than TEXCOORD_0 and TEXCOORD_1.
struct MaterialTextures {
  std::optional<TextureReference> base;
  std::optional<TextureReference> emission;
  std::optional<TextureReference> normals;
};

/// Errors (without a file): kMalformed for broken extensions.
MaterialTextures texturesOf(const tinygltf::Model& model, const tinygltf::Material& material);

/// Index into SceneFile::images of a picture. The same picture as colours and as normals is two.
using ImageIndex = std::function<std::uint32_t(const TextureReference& reference)>;

/// Errors: as texturesOf.
Material readMaterial(const tinygltf::Model& model, const tinygltf::Material& material, const ImageIndex& imageIndex);

}  // namespace jalousie::asset::detail
