// Factors, textures with their samplers and KHR_texture_transform, KHR_materials_unlit and _emissive_strength.
#include "asset/scene_material.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "asset/gltf_images.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kStrength = "KHR_materials_emissive_strength";

AlphaMode alphaMode(const std::string& name) {
  if (name == "MASK") return AlphaMode::kMask;
  if (name == "BLEND") return AlphaMode::kBlend;
  return AlphaMode::kOpaque;
}

Wrap wrapOf(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::kClamp;
  if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::kMirror;
  return Wrap::kRepeat;
}

Sampling samplingOf(const tinygltf::Model& model, const tinygltf::Texture& texture) {
  Sampling sampling;
  if (texture.sampler < 0) return sampling;
  const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
  sampling.wrapU = wrapOf(sampler.wrapS);
  sampling.wrapV = wrapOf(sampler.wrapT);
  sampling.magnifyNearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  switch (sampler.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      sampling.minifyNearest = true;
      [[fallthrough]];
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      sampling.mip = Mip::kNone;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      sampling.minifyNearest = true;
      [[fallthrough]];
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      sampling.mip = Mip::kNearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      sampling.minifyNearest = true;
      break;
    default:
      break;
  }
  return sampling;
}

/// A number of an extension. Errors: kMalformed if it is none, or not finite as a float.
float numberOf(const tinygltf::Value& value) {
  const auto number = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : std::nanf("");
  if (!std::isfinite(number)) throw Error(ErrorCode::kMalformed, fmt::format("{} without numbers", kTransform));
  return number;
}

glm::vec2 pairOf(const tinygltf::Value& extension, const char* name, const glm::vec2& fallback) {
  if (!extension.Has(name)) return fallback;
  const tinygltf::Value& pair = extension.Get(name);
  if (!pair.IsArray() || pair.ArrayLen() != 2)
    throw Error(ErrorCode::kMalformed, fmt::format("{}: {} has not two numbers", kTransform, name));
  return {numberOf(pair.Get(0)), numberOf(pair.Get(1))};
}

/// Offset, rotation and scale of KHR_texture_transform, in this order.
void transform(const tinygltf::Value& extension, TextureUse& use, int& texCoord) {
  if (!extension.IsObject()) return;
  const glm::vec2 scale = pairOf(extension, "scale", glm::vec2(1.0F));
  const float angle = extension.Has("rotation") ? numberOf(extension.Get("rotation")) : 0.0F;
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  use.uvOffset = pairOf(extension, "offset", glm::vec2(0.0F));
  use.uvAxes = {scale.x * c, -scale.x * s, scale.y * s, scale.y * c};
  if (extension.Has("texCoord") && extension.Get("texCoord").IsInt())
    texCoord = extension.Get("texCoord").GetNumberAsInt();
}

/// @param info  of type TextureInfo, NormalTextureInfo
template <class Info>
std::optional<TextureReference> referenceOf(const tinygltf::Model& model, const Info& info, bool isData) {
  if (info.index < 0) return std::nullopt;
  const tinygltf::Texture& texture = model.textures[static_cast<std::size_t>(info.index)];
  TextureReference reference{imageOfTexture(texture), isData, {}};
  int texCoord = info.texCoord;
  const auto extension = info.extensions.find(kTransform);
  if (extension != info.extensions.end()) transform(extension->second, reference.use, texCoord);
  if (reference.image < 0 || texCoord < 0 || texCoord > 1) return std::nullopt;
  if (model.images[static_cast<std::size_t>(reference.image)].image.empty()) return std::nullopt;  // missing
  reference.use.uvSet = static_cast<std::uint32_t>(texCoord);
  reference.use.sampling = samplingOf(model, texture);
  return reference;
}

glm::vec3 emissionOf(const tinygltf::Material& material) {
  glm::vec3 emission(0.0F);
  for (int i = 0; i < 3 && material.emissiveFactor.size() == 3; ++i)
    emission[i] = static_cast<float>(material.emissiveFactor[static_cast<std::size_t>(i)]);
  const auto extension = material.extensions.find(kStrength);
  if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength")) return emission;
  const tinygltf::Value& value = extension->second.Get("emissiveStrength");
  const auto strength = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : std::nanf("");
  if (!std::isfinite(strength) || strength < 0.0F)
    throw Error(ErrorCode::kMalformed, fmt::format("{}: the strength is no finite number of at least 0", kStrength));
  return emission * strength;
}

std::optional<TextureUse> useOf(const std::optional<TextureReference>& reference, const ImageIndex& imageIndex) {
  if (!reference) return std::nullopt;
  TextureUse use = reference->use;
  use.image = imageIndex(*reference);
  return use;
}

}  // namespace

MaterialTextures texturesOf(const tinygltf::Model& model, const tinygltf::Material& material) {
  MaterialTextures textures;
  textures.base = referenceOf(model, material.pbrMetallicRoughness.baseColorTexture, false);
  if (material.extensions.contains(kUnlit)) return textures;
  if (emissionOf(material) != glm::vec3(0.0F)) textures.emission = referenceOf(model, material.emissiveTexture, false);
  textures.normals = referenceOf(model, material.normalTexture, true);
  return textures;
}

Material readMaterial(const tinygltf::Model& model, const tinygltf::Material& source, const ImageIndex& imageIndex) {
  Material material;
  material.name = source.name;
  const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
  for (int i = 0; i < 4 && factor.size() == 4; ++i)
    material.baseColor[i] = static_cast<float>(factor[static_cast<std::size_t>(i)]);
  const MaterialTextures textures = texturesOf(model, source);
  material.baseTexture = useOf(textures.base, imageIndex);
  material.emissiveTexture = useOf(textures.emission, imageIndex);
  material.normalTexture = useOf(textures.normals, imageIndex);
  material.isUnlit = source.extensions.contains(kUnlit);
  if (!material.isUnlit) material.emission = emissionOf(source);
  material.normalScale = static_cast<float>(source.normalTexture.scale);
  material.alphaMode = alphaMode(source.alphaMode);
  material.alphaCutoff = static_cast<float>(source.alphaCutoff);
  material.doubleSided = source.doubleSided;
  return material;
}

}  // namespace jalousie::asset::detail
