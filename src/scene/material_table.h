// Materials as the shaders read them.
#pragma once

#include "asset/scene_types.h"
#include "scene/texture_layers.h"
#include "shared/limits.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {

/// Draw list of a material: kListSolid, kListSheet or kListBlend.
gpu::uint listOf(const asset::Material& material);
/// @param layout  of the textures that the material uses
gpu::Material makeMaterial(const asset::Material& material, const TextureLayout& layout);
/// Whether a material needs the programs with JAL_FULL_MATERIALS.
bool isFull(const asset::Material& material);

}  // namespace jalousie::scene
