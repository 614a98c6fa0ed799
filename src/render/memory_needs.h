// Estimated memory of a renderer: buffers, textures and targets, and what the driver copies of them.
#pragma once

#include <cstdint>

#include "core/memory_estimate.h"
#include "render/frame_options.h"
#include "scene/scene_memory.h"

namespace jalousie::render {

/// Programs, shaders compiled by a software renderer, and the process itself.
inline constexpr std::uint64_t kProgramBytes = 160ULL << 20U;

/// Buffers and textures of one scene. @param patches  as scene::BuildOptions::patches
MemoryEstimate bufferNeeds(const scene::SceneSize& size, bool patches, const RendererOptions& options);

/// Targets, occlusion map and depth pyramid of one size, in pixels.
MemoryEstimate targetNeeds(std::uint32_t width, std::uint32_t height);

/// A picture that is read back and encoded as PNG.
MemoryEstimate pictureNeeds(std::uint32_t width, std::uint32_t height);

}  // namespace jalousie::render
