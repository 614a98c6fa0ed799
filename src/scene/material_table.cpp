// Flags, texture places and sampling bits of materials.
#include "scene/material_table.h"

#include <bit>

namespace jalousie::scene {
namespace {

gpu::uint samplingBits(const asset::TextureUse& use, const TextureClass& size) {
  const asset::Sampling& sampling = use.sampling;
  const auto wrap = [](asset::Wrap wrapped, gpu::uint clamp, gpu::uint mirror) {
    return wrapped == asset::Wrap::kClamp ? clamp : wrapped == asset::Wrap::kMirror ? mirror : 0U;
  };
  gpu::uint bits = wrap(sampling.wrapU, gpu::kSamplingClampU, gpu::kSamplingMirrorU) |
                   wrap(sampling.wrapV, gpu::kSamplingClampV, gpu::kSamplingMirrorV);
  if (sampling.magnifyNearest) bits |= gpu::kSamplingMagnifyNearest;
  if (sampling.minifyNearest) bits |= gpu::kSamplingMinifyNearest;
  if (sampling.mip == asset::Mip::kNearest) bits |= gpu::kSamplingMipNearest;
  if (sampling.mip == asset::Mip::kNone) bits |= gpu::kSamplingMipNone;
  if (use.uvSet == 1) bits |= gpu::kSamplingSecondUv;
  bits |= static_cast<gpu::uint>(std::countr_zero(size.width)) << gpu::kSamplingWidthShift;
  return bits | static_cast<gpu::uint>(std::countr_zero(size.height)) << gpu::kSamplingHeightShift;
}

gpu::TextureUse makeTextureUse(const asset::TextureUse& use, const TextureLayout& layout) {
  const TextureSlot& slot = layout.slots[use.image];
  return {use.uvAxes, use.uvOffset, slot.layer | slot.textureClass << 16U,
          samplingBits(use, layout.classes[slot.textureClass])};
}

}  // namespace

gpu::uint listOf(const asset::Material& material) {
  if (material.alphaMode == asset::AlphaMode::kBlend) return gpu::kListBlend;
  return material.doubleSided || material.alphaMode == asset::AlphaMode::kMask ? gpu::kListSheet : gpu::kListSolid;
}

gpu::Material makeMaterial(const asset::Material& material, const TextureLayout& layout) {
  gpu::Material result{};
  result.baseColor = material.baseColor;
  result.emission = glm::vec4(material.emission, material.normalScale);
  result.alphaCutoff = material.alphaCutoff;
  const auto add = [&](const std::optional<asset::TextureUse>& use, gpu::uint flag, gpu::TextureUse& target) {
    if (!use) return;
    result.flags |= flag;
    target = makeTextureUse(*use, layout);
  };
  add(material.baseTexture, gpu::kMaterialTextured, result.base);
  add(material.emissiveTexture, gpu::kMaterialEmissionTextured, result.emissive);
  add(material.normalTexture, gpu::kMaterialNormalTextured, result.normals);
  if (material.isUnlit) result.flags |= gpu::kMaterialUnlit;
  if (material.doubleSided) result.flags |= gpu::kMaterialDoubleSided;
  if (material.alphaMode == asset::AlphaMode::kMask) result.flags |= gpu::kMaterialMask;
  if (material.alphaMode == asset::AlphaMode::kBlend) result.flags |= gpu::kMaterialBlend;
  return result;
}

bool isFull(const asset::Material& material) {
  return (material.baseTexture && !material.baseTexture->isPlain()) || material.emission != glm::vec3(0.0F) ||
         material.normalTexture || material.isUnlit;
}

}  // namespace jalousie::scene
