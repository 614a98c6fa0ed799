// Warnings that several subcommands give, each one line on standard error.
#pragma once

#include <filesystem>

#include "gl/capabilities.h"
#include "scene/scene_data.h"

namespace jalousie::app {

void warnUnmeasuredLevels(const std::filesystem::path& file);

/// Warns if the renderer cannot draw the level asked for. @param scene  with patches
void warnTessellationLimit(const std::filesystem::path& file, const scene::SceneData& scene,
                           const gl::Capabilities& capabilities, gpu::uint wanted);

}  // namespace jalousie::app
