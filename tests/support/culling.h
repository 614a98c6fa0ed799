// Counts pixels that culling took away: the same frame with and without it, as object numbers and as depth.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::test {

/// Levels by projected error alone: what is compared must not depend on what was seen before.
inline render::FrameOptions pixelErrorOptions() {
  render::FrameOptions options;
  options.lodRule = LodRule::kPixelError;
  return options;
}

/// A scene and what happens in it. Frames are counted from 0.
struct Journey {
  std::string name;
  scene::SceneData scene;
  std::function<scene::Camera(std::uint32_t frame)> camera;
  /// Moves objects before a frame; starts from the scene's own transforms. May be empty.
  std::function<void(std::uint32_t frame, std::span<gpu::Transform>)> move;
};

/// What a mode lost over a journey.
struct CullingLoss {
  std::uint64_t frames = 0;
  std::uint64_t wrongPixels = 0;      ///< show an object in the reference that the mode did not draw
  std::uint64_t worstFrame = 0;       ///< most wrong pixels in one frame
  std::uint64_t differentDepths = 0;  ///< pixels whose depth is not the reference's, bit for bit
  std::uint64_t culled = 0;           ///< objects found hidden, summed over the frames
  std::uint64_t triangles = 0;        ///< drawn, summed over the frames
  std::uint64_t referenceTriangles = 0;
};

/// Renders `frames` frames from `firstFrame` on at one size, with history from frame to frame, and each one again
/// without any culling. The levels of detail are the same in both: finest or by pixel error.
/// @pre options.lodRule is kLodFinest or kLodPixelError (checked)
CullingLoss countLoss(const Journey& journey, std::uint32_t width, std::uint32_t height,
                      const render::FrameOptions& options, std::uint32_t firstFrame, std::uint32_t frames);

/// Four kinds of camera path in turn, `framesEach` frames each: around the scene from outside, through its objects,
/// turning fast on the spot, and cuts from place to place. Deterministic for a seed.
std::function<scene::Camera(std::uint32_t frame)> tour(const scene::SceneData& scene, std::uint32_t framesEach,
                                                       std::uint64_t seed);

/// Every `stride`-th object swings by up to its own size and spins, in every frame.
std::function<void(std::uint32_t frame, std::span<gpu::Transform>)> swingObjects(const scene::SceneData& scene,
                                                                                 std::uint32_t stride);

// Scenes that broke culling elsewhere.
/// Spheres of 12:1 sizes on and around a ground plane much larger than all of them.
asset::SceneFile groundPlane(std::uint32_t count, std::uint64_t seed);
/// Walls of masked leaf cards whose texture has single-texel holes, and spheres behind and between them.
asset::SceneFile leafCards(std::uint32_t cards, std::uint32_t spheres, std::uint64_t seed);

// Scenes with occluders.
/// Houses of one to three boxes, some turned, mirrored and stretched, with their boxes as occluders; spheres of four
/// levels between and in them, with an occluder that lies inside of the first `sphereLevels`.
/// @param larger  by which the houses' occluders are scaled
asset::SceneFile town(std::uint32_t houses, std::uint32_t spheres, std::uint64_t seed, float larger = 1.0F,
                      std::uint32_t sphereLevels = 4);

}  // namespace jalousie::test
