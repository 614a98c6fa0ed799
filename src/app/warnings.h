// Warnings that several subcommands give, each one line on standard error.
#pragma once

#include <cstdint>
#include <filesystem>

#include "gl/capabilities.h"
#include "policy/lod_rule.h"
#include "render/frame_statistics.h"
#include "scene/scene_data.h"

namespace jalousie::app {

/// Says what of a file is not drawn; nothing if everything is.
void warnIgnored(const std::filesystem::path& file, const asset::ContentCounts& ignored);

/// Warns of levels that a rule cannot judge: those without a stored error or, by coverage, chains without thresholds.
void warnUnknownLevels(const std::filesystem::path& file, const scene::SceneData& scene, const LodRuleRow& rule);

/// Says that a camera does not move.
void warnSingleFrame(const std::filesystem::path& file);

/// Warns if the renderer cannot draw the level asked for. @param scene  with patches
void warnTessellationLimit(const std::filesystem::path& file, const scene::SceneData& scene,
                           const gl::Capabilities& capabilities, gpu::uint wanted);

/// Warns if a frame has missed its budget of triangles by more than 5 %, unless no choice of levels comes nearer.
/// @param budget  0: there is none   @param settle  frames that were rendered before
void warnTriangleBudget(const std::filesystem::path& file, std::uint64_t budget,
                        const render::FrameStatistics& statistics, std::uint32_t settle);

}  // namespace jalousie::app
