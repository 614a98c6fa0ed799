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
    asset::checkScene(asset::parseGltf(glb, file), file);
  } catch (const Error& error) {
    const std::string prefix = file.string() + ": ";
    const std::string reason = error.what();
    throw Error(error.code(), fmt::format("the result could not be read again: {}",
                                          reason.starts_with(prefix) ? reason.substr(prefix.size()) : reason));
  }
}

}  // namespace jalousie::bake
