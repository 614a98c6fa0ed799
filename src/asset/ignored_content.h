// What a document holds that is not drawn.
#pragma once

#include <tiny_gltf.h>

#include <string>

#include "asset/scene_types.h"

namespace jalousie::asset {

/// Counts by name what readScene leaves out and what drawing leaves out: "clearcoat" materials (of an extension
/// KHR_materials_clearcoat), "lights", "animation channels", "textures of metalness and roughness" and others. Empty
/// for a document that is drawn as it is. The shading is no physically based one, so factors of metalness and roughness
/// do not count.
/// @param isTimed  the animations are shown at a time
ContentCounts ignoredContent(const tinygltf::Model& model, bool isTimed);

/// "3 clearcoat, 2 skins" in the order of the names; empty for no content.
std::string toText(const ContentCounts& counts);

}  // namespace jalousie::asset
