// Runs the readers of the other programs over the result.
#include "bake/io/read_back.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "asset/gltf_file.h"
#include "asset/scene_file.h"
#include "core/error.h"

namespace jalousie::bake {

void requireReadable(std::span<const std::byte> glb, const std::filesystem::path& file) {
  try {
    tinygltf::Model model = asset::parseGltf(glb, file);
    for (tinygltf::Material& material : model.materials)
      material.pbrMetallicRoughness.baseColorTexture.index = -1;  // the scene reader would decode the images
    asset::readScene(model, file);
  } catch (const Error& error) {
    const std::string prefix = file.string() + ": ";
    const std::string reason = error.what();
    throw Error(error.code(), fmt::format("the result could not be read again: {}",
                                          reason.starts_with(prefix) ? reason.substr(prefix.size()) : reason));
  }
}

}  // namespace jalousie::bake
