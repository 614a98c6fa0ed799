// Reads a glTF document into the plain types that a renderer needs.
#pragma once

#include <filesystem>

#include <functional>
#include <optional>

#include "asset/read_limits.h"
#include "asset/scene_size.h"
#include "asset/scene_types.h"

namespace tinygltf {
class Model;
}

namespace jalousie::asset {

/// Judges a scene by its size. Throws what readSceneFile shall throw.
using SizeCheck = std::function<void(const SceneSize& size)>;

/// How a scene is read.
struct SceneReading {
  SizeCheck check = {};  ///< called with the scene's size before anything of it is allocated; may be empty
  std::optional<double> seconds = std::nullopt;  ///< time of the animations of nodes, skins and morph targets; absent:
                                                 ///< the pose without animations. Cameras have their whole paths
  /// Reads the animations of nodes, skins and morph targets as SceneFile::motion. The scene itself then has the pose
  /// without animations. @pre without seconds
  bool plays = false;
};

/// Reads the default scene (or scene 0, or all root nodes) of a glTF or GLB file. Nodes listed only in MSFT_lod are
/// LOD levels, not instances. A mesh with a skin or morph targets is bent as its node says, and is then a mesh of its
/// own. The keys of a STEP track of a camera are doubled, so that linear interpolation repeats the steps. Errors: as
/// loadGltf; kMalformed for NaN or infinite positions and transforms; kLimit.
SceneFile readSceneFile(const std::filesystem::path& path, const Limits& limits = {}, const ReadObserver& observer = {},
                        const SceneReading& reading = {});
/// As readSceneFile, for a document that is loaded already. @param path  the document's file, for messages
SceneFile readScene(const tinygltf::Model& model, const std::filesystem::path& path, const Limits& limits = {},
                    const SceneReading& reading = {});
/// Reads a scene as readScene does, for its errors alone: keeps no instances and decodes no images.
void checkScene(const tinygltf::Model& model, const std::filesystem::path& path, const Limits& limits = {});

}  // namespace jalousie::asset
