// Cameras and options to uniform blocks.
#include "render/frame_views.h"

#include <algorithm>
#include <limits>

#include "scene/patch_base.h"
#include "visibility/classify_reference.h"

namespace jalousie::render {
namespace {

/// Depth of the occluder layer as a share of the scene's diagonal (docs/occlusion_map.md).
constexpr float kOccluderDepth = 0.12F;

float aspectOf(const ViewSetting& setting) {
  return static_cast<float>(setting.width) / static_cast<float>(setting.height);
}

glm::vec4 forwardOf(const scene::Camera& camera) {
  return {camera.forwardWorld(), camera.isOrthographic() ? 1.0F : 0.0F};
}

}  // namespace

float automaticOccluderDistance(const gpu::CullView& view, const Aabb& sceneWorld) {
  if (sceneWorld.empty()) return 0.0F;
  return visibility::distanceFromEye(view, sceneWorld) + kOccluderDepth * sceneWorld.diagonal();
}

gpu::CullView makeCullView(const FrameOptions& options, const scene::Camera& camera, const ViewSetting& setting) {
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, aspectOf(setting));
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.forwardWorld = forwardOf(camera);
  view.viewportWidth = setting.width;
  view.viewportHeight = setting.height;
  view.objectCount = setting.objectCount;
  view.cellCount = setting.cellCount;
  view.cullCells = options.cullCells ? 1 : 0;
  view.traits = traitsOf(options);
  view.analyse = wantsLv(options) ? 1 : 0;
  view.mapLevels = setting.mapLevels;
  view.occluderDistance = options.occluderDistance.value_or(automaticOccluderDistance(view, setting.sceneWorld));
  view.cullThreshold = options.cullThreshold;
  view.maxTessellation = std::min(options.maxTessellation, setting.tessellationLimit);
  view.focalPixels = scene::focalPixels(camera, {setting.width, setting.height});
  view.tau = options.tau;
  view.occluderTau = options.occluderTau.value_or(rowOf(options.cullMode).occluderTau);
  view.minPixels = options.minPixels;
  view.minSpherePixels = options.minSpherePixels;
  view.relax = options.relax;
  view.maxError = options.maxError > 0.0F ? options.maxError : std::numeric_limits<float>::infinity();
  view.triangleBudget = rowOf(options.lodRule).pricesTriangles ? options.triangleBudget : 0;
  view.calm = options.calm ? 1 : 0;
  view.measureCover = rowOf(options.view).measuresCover ? 1 : 0;
  view.hysteresis = options.hysteresis;
  view.fadeFrames = std::min(options.fadeFrames, gpu::kMaxFadeFrames);
  return view;
}

gpu::DrawView makeDrawView(const FrameOptions& options, const scene::Camera& camera, const ViewSetting& setting,
                           const gpu::CullView& cull) {
  gpu::DrawView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, aspectOf(setting));
  view.cameraWorld = glm::vec4(camera.positionWorld(), 1.0F);
  view.forwardWorld = forwardOf(camera);
  view.lightWorld = glm::vec4(glm::normalize(glm::vec3(0.35F, 1.0F, 0.45F)), 0.0F);
  view.view = static_cast<gpu::uint>(options.view);
  view.patches = rowOf(options.detail).patches ? 1 : 0;
  view.mapLevel = std::min(options.mapLevel, setting.mapLevels - 1);
  view.phongAlpha = scene::kPhongAlpha;
  view.viewportWidth = setting.width;
  view.viewportHeight = setting.height;
  view.maxTessellation = cull.maxTessellation;
  view.depthGuard = 0.0F;
  view.fadeFrames = cull.fadeFrames;
  return view;
}

}  // namespace jalousie::render
