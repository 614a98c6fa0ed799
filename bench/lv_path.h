// A slow path around the centre of a scene, and the LOD switches along it.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "render/frame_renderer.h"
#include "scene/camera.h"

namespace jalousie::bench {

/// A camera that turns around a vertical axis by 0.25 degrees per frame.
struct Path {
  scene::Camera start;
  glm::vec3 center;  ///< on the axis, world space
  int frames;        ///< of the path

  scene::Camera at(int frame) const;
};

/// Renders frames with the camera at rest, so that the start is no part of the path, and then frames 1 to Path::frames.
/// History is not forgotten first.
/// @param isDrawn  whether a frame's picture is needed; others are rendered with FrameOptions::skipDraw
/// @param visit    called after each frame of the path
void walk(render::FrameRenderer& renderer, const render::FrameOptions& options, const Path& path,
          const std::function<bool(int frame)>& isDrawn, const std::function<void(int frame)>& visit);

/// LOD switches of visible objects, summed over frames.
struct SwitchTotals {
  double switched = 0.0;
  double visible = 0.0;

  /// Adds those of the renderer's last frame. Ends the benchmark if the counts do not agree.
  void add(render::FrameRenderer& renderer);
  /// Share of the visible objects that switch per frame. Ends the benchmark if no object was visible.
  double perObject() const;
};

}  // namespace jalousie::bench
