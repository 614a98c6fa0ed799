// classify -> occluders -> reduce -> analyse -> emit -> draw (thesis ch. 3, 4.1).
#include "render/frame_renderer.h"

#include <algorithm>
#include <array>

#include "render/tessellation_limit.h"
#include "scene/patch_base.h"

namespace jalousie::render {
namespace {

/// Depth of the occluder layer as a share of the scene's diagonal (docs/occlusion_map.md).
constexpr float kOccluderDepth = 0.12F;

constexpr std::array<float, 4> kBackground = {0.235F, 0.29F, 0.36F, 1.0F};  // linear RGB

}  // namespace

float automaticOccluderDistance(const glm::vec3& eyeWorld, const Aabb& sceneWorld) {
  if (sceneWorld.empty()) return 0.0F;
  const glm::vec3 outside = glm::max(glm::max(sceneWorld.min - eyeWorld, eyeWorld - sceneWorld.max), glm::vec3(0.0F));
  return glm::length(outside) + kOccluderDepth * sceneWorld.diagonal();
}

FrameRenderer::FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height)
    : scene_(scene),
      width_(width),
      height_(height),
      tessellationLimit_(tessellationLimit(gl::queryCapabilities(), scene.maxPatchTriangles)),
      buffers_(scene),
      map_(visibility::mapLayout(width, height)),
      visibility_(buffers_.objectCount()),
      color_(GL_TEXTURE_2D, GL_SRGB8_ALPHA8, {width, height, 1, 1}, "frame colour"),
      depth_(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {width, height, 1, 1}, "frame depth"),
      target_(color_, &depth_, "frame") {}

void FrameRenderer::render(const FrameOptions& options, const scene::Camera& cullCamera,
                           const scene::Camera& drawCamera) noexcept {
  timer_.beginFrame();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  setViews(options, cullCamera, drawCamera);
  const visibility::SceneBindings bindings = buffers_.bindings();
  {
    const gl::PassTimer::Scope pass(timer_, "classify");
    visibility_.classify(bindings);
  }
  const bool usesMap = options.cullMode == gpu::kCullHom;
  if (usesMap) {
    drawOccluders();
    {
      const gl::PassTimer::Scope pass(timer_, "reduce");
      map_.reduce();
    }
    const gl::PassTimer::Scope pass(timer_, "analyse");
    visibility_.analyse(bindings, map_);
  }
  {
    const gl::PassTimer::Scope pass(timer_, "emit");
    visibility_.emitCommands(bindings);
  }
  if (!options.skipDraw) drawFrame(options);
}

void FrameRenderer::setViews(const FrameOptions& options, const scene::Camera& cullCamera,
                             const scene::Camera& drawCamera) {
  const float aspect = static_cast<float>(width_) / static_cast<float>(height_);
  const glm::vec3 eye = cullCamera.positionWorld();
  cullView_.clipFromWorld = scene::clipFromWorld(cullCamera, aspect);
  cullView_.cameraWorld = glm::vec4(eye, 1.0F);
  cullView_.viewportWidth = width_;
  cullView_.viewportHeight = height_;
  cullView_.objectCount = buffers_.objectCount();
  cullView_.cullMode = options.cullMode;
  cullView_.lodRule = options.lodRule;
  cullView_.detail = options.detail;
  cullView_.analyse = options.lodRule == gpu::kLodLinear || options.view == gpu::kViewLv ? 1 : 0;
  cullView_.mapLevels = map_.layout().levels;
  cullView_.occluderDistance =
      options.occluderDistance ? *options.occluderDistance : automaticOccluderDistance(eye, scene_.boundsWorld);
  cullView_.cullThreshold = options.cullThreshold;
  cullView_.maxTessellation = std::min(options.maxTessellation, tessellationLimit_);
  visibility_.setView(cullView_);

  drawView_.clipFromWorld = scene::clipFromWorld(drawCamera, aspect);
  drawView_.cameraWorld = glm::vec4(drawCamera.positionWorld(), 1.0F);
  drawView_.lightWorld = glm::vec4(glm::normalize(glm::vec3(0.35F, 1.0F, 0.45F)), 0.0F);
  drawView_.view = options.view;
  drawView_.detail = options.detail;
  drawView_.mapLevel = options.mapLevel < map_.layout().levels ? options.mapLevel : map_.layout().levels - 1;
  drawView_.phongAlpha = scene::kPhongAlpha;
  drawView_.maxTessellation = cullView_.maxTessellation;
  drawView_.viewportWidth = width_;
  drawView_.viewportHeight = height_;
}

void FrameRenderer::drawOccluders() {
  const gl::PassTimer::Scope pass(timer_, "occluders");
  gpu::DrawView view = drawView_;
  view.clipFromWorld = cullView_.clipFromWorld;
  view.cameraWorld = cullView_.cameraWorld;
  draw_.setView(view);
  map_.beginOccluders();
  draw_.draw(DrawKind::kOpacity, cullView_.detail, buffers_, visibility_.commands(), visibility_.states());
}

void FrameRenderer::drawFrame(const FrameOptions& options) {
  const gl::PassTimer::Scope pass(timer_, "draw");
  draw_.setView(drawView_);
  target_.bind(width_, height_);
  glEnable(GL_FRAMEBUFFER_SRGB);
  if (options.view == gpu::kViewOcclusion) {
    draw_.drawMap(map_);
  } else {
    const float farDepth = 0.0F;  // reversed depth
    glClearNamedFramebufferfv(target_.id(), GL_COLOR, 0, kBackground.data());
    glClearNamedFramebufferfv(target_.id(), GL_DEPTH, 0, &farDepth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    draw_.draw(DrawKind::kShaded, options.detail, buffers_, visibility_.commands(), visibility_.states());
    glDisable(GL_DEPTH_TEST);
  }
  glDisable(GL_FRAMEBUFFER_SRGB);
}

FrameStatistics FrameRenderer::readStatistics() const {
  return countFrame(scene_, cullView_, readStates());
}

std::vector<gpu::ObjectState> FrameRenderer::readStates() const {
  return visibility_.states().read<gpu::ObjectState>(buffers_.objectCount());
}

std::vector<gpu::ScreenRect> FrameRenderer::readRects() const {
  return visibility_.rects().read<gpu::ScreenRect>(buffers_.objectCount());
}

std::vector<gpu::DrawCommand> FrameRenderer::readCommands() const {
  return visibility_.commands().read<gpu::DrawCommand>(std::size_t{gpu::kListCount} * buffers_.objectCount());
}

}  // namespace jalousie::render
