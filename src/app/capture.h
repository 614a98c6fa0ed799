// One picture of a state, and its figures: what `jalousie render` writes and what the viewer saves.
#pragma once

#include <cstdint>
#include <functional>

#include "app/render_cameras.h"
#include "app/render_report.h"
#include "gl/capabilities.h"
#include "render/frame_renderer.h"

namespace jalousie::app {

/// Renders as from a fresh start: history is forgotten, the visible set settles, options.repeat frames are measured.
/// The picture is then renderer.readImage(). Waits for the GPU.
/// @param options   finished; their size is the renderer's
/// @param progress  told the number of each frame before it is rendered; may be empty
RenderReport captureFrame(const RenderOptions& options, render::FrameRenderer& renderer,
                          const gl::Capabilities& capabilities, const RenderCameras& cameras,
                          const std::function<void(std::uint32_t frame)>& progress = {});

/// Frames that captureFrame() renders.
std::uint32_t captureFrames(const RenderOptions& options);

}  // namespace jalousie::app
