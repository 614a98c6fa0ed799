// The uniform blocks of one frame: the culling view with its policy, and the drawing view.
#pragma once

#include <cstdint>

#include "core/aabb.h"
#include "render/frame_options.h"
#include "scene/camera.h"
#include "shared/frame_structs.h"

namespace jalousie::render {

/// What the views take from the renderer and not from the frame's options.
struct ViewSetting {
  std::uint32_t width = 0;  ///< pixels
  std::uint32_t height = 0;
  std::uint32_t objectCount = 0;
  std::uint32_t cellCount = 0;
  std::uint32_t mapLevels = 0;
  gpu::uint tessellationLimit = 1;
  Aabb sceneWorld;
};

/// The culling camera and the policy as the kernels read them. countsValid and the importance mask are the pass' own.
gpu::CullView makeCullView(const FrameOptions& options, const scene::Camera& camera, const ViewSetting& setting);
/// The drawing camera. @param cull  of the same frame
gpu::DrawView makeDrawView(const FrameOptions& options, const scene::Camera& camera, const ViewSetting& setting,
                           const gpu::CullView& cull);

/// Distance from the eye to the scene's box plus kOccluderDepth of its diagonal: the front layer of objects, from
/// outside and inside. World units. @param view  cameraWorld and forwardWorld count
float automaticOccluderDistance(const gpu::CullView& view, const Aabb& sceneWorld);

}  // namespace jalousie::render
