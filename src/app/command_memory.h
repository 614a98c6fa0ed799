// How much memory a command is about to allocate, and scenes that are read within a limit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/render_options.h"
#include "asset/scene_file.h"
#include "core/memory_estimate.h"
#include "scene/scene_data.h"

namespace jalousie::app {

/// Estimated peak of a command, from the size of its scene.
using Needs = std::function<MemoryEstimate(const asset::SceneSize& size)>;

/// What else is asked of a scene.
struct SceneRequest {
  asset::ReadObserver observer = {};
  std::optional<double> seconds = std::nullopt;  ///< time of its animations; absent: the pose without
  bool plays = false;                            ///< read the animations, to play them; without seconds
};

/// Reads a scene if the command's needs are within the limit. Errors: kLimit, before the scene is read; as
/// readSceneFile.
asset::SceneFile readWithin(const std::filesystem::path& file, const MemoryLimit& limit, const Needs& needs,
                            const SceneRequest& request = {});

/// A mask of --importance: its file, the decoded picture, the mask and its texture. Nothing without a file.
/// Errors: as imageSize, for the file.
MemoryEstimate maskNeeds(const std::filesystem::path& file);
/// For cameras alone: the file and nothing else.
MemoryEstimate readingNeeds(const asset::SceneSize& size);
/// For a scene without a picture: the file and the flat arrays.
MemoryEstimate flatNeeds(const asset::SceneSize& size);
/// `jalousie render`, of a scene without cells, which the options add: the file is gone when the renderer is made.
MemoryEstimate renderNeeds(const asset::SceneSize& whole, const RenderOptions& options);
/// One configuration of the viewer: the file stays.
MemoryEstimate viewNeeds(const asset::SceneSize& whole, const RenderOptions& options);

/// What experiments keep at the same time.
struct ComparisonSize {
  std::uint64_t renderers = 1;
  std::uint64_t configurations = 1;         ///< each has a picture of the present frame
  std::vector<scene::BuildOptions> builds;  ///< of the configurations, beside the plain scene of the reference
  bool pictures = false;                    ///< they are compared with a reference
  bool butteraugli = false;                 ///< with Butteraugli, too
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};
/// `jalousie compare`.
MemoryEstimate compareNeeds(const asset::SceneSize& size, const ComparisonSize& comparison);

}  // namespace jalousie::app
