// Reads a glTF document into the plain types that a renderer needs.
#pragma once

#include <filesystem>

#include "asset/read_limits.h"
#include "asset/scene_types.h"

namespace tinygltf {
class Model;
}

namespace jalousie::asset {

/// Reads the default scene (or scene 0, or all root nodes) of a glTF or GLB file. Nodes listed only in MSFT_lod are
/// LOD levels, not instances. Of a CUBICSPLINE track only the keys are read; the keys of a STEP track are doubled, so
/// that linear interpolation repeats the steps. Errors: as loadGltf; kMalformed for NaN or infinite positions and
/// transforms; kLimit.
SceneFile readSceneFile(const std::filesystem::path& path, const Limits& limits = {},
                        const ReadObserver& observer = {});
/// As readSceneFile, for a document that is loaded already. @param path  the document's file, for messages
SceneFile readScene(const tinygltf::Model& model, const std::filesystem::path& path, const Limits& limits = {});

}  // namespace jalousie::asset
