// Frame times of several configurations in one run.
#pragma once

#include <string_view>
#include <vector>

#include "render/frame_renderer.h"
#include "scene/camera.h"

namespace jalousie::bench {

/// What is timed. Several may share a renderer.
struct Timed {
  render::FrameRenderer& renderer;
  render::FrameOptions options;
};

/// Median times of kCountInterval frames at one camera, one of which counts pixels; ms. The configurations run in turn,
/// each after two frames in which it settles, and every other round in the opposite order.
/// @param pass  the only pass that counts; empty: all
std::vector<double> interleavedTimes(const std::vector<Timed>& all, const scene::Camera& camera, int rounds,
                                     std::string_view pass = {});

}  // namespace jalousie::bench
