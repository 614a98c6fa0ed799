// One phase:  classify -> [occluders -> map -> analyse] -> list -> draw (thesis ch. 3, 4.1).
// Two phases: classify -> list -> draw -> depth pyramid -> analyse -> list -> draw (docs/two_phase_culling.md).
#include "render/frame_renderer.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "render/tessellation_limit.h"
#include "scene/patch_base.h"

namespace jalousie::render {
namespace {

/// Depth of the occluder layer as a share of the scene's diagonal (docs/occlusion_map.md).
constexpr float kOccluderDepth = 0.12F;

constexpr std::array<float, 4> kBackground = {0.235F, 0.29F, 0.36F, 1.0F};  // linear RGB
constexpr std::array<GLuint, 4> kNoObject = {};
constexpr float kFarDepth = 0.0F;  // reversed depth

bool usesMap(gpu::uint cullMode) {
  return cullMode == gpu::kCullHom || cullMode == gpu::kCullHomDepth;
}

gl::Capabilities capabilitiesFor(const RendererOptions& options) {
  const gl::Capabilities capabilities = gl::queryCapabilities();
  return options.fastPaths ? capabilities : capabilities.withoutFastPaths();
}

visibility::DrawListOptions listOptions(const scene::SceneData& scene, const RendererOptions& options) {
  const auto objects = static_cast<std::uint32_t>(scene.objects.size());
  const std::uint32_t most = 2 * objects;  // what is cross-faded is on the list twice
  return {options.submission, std::min(options.capacity.value_or(most), most), scene.maxPatchTriangles > 0};
}

}  // namespace

float automaticOccluderDistance(const glm::vec3& eyeWorld, const Aabb& sceneWorld) {
  if (sceneWorld.empty()) return 0.0F;
  const glm::vec3 outside = glm::max(glm::max(sceneWorld.min - eyeWorld, eyeWorld - sceneWorld.max), glm::vec3(0.0F));
  return glm::length(outside) + kOccluderDepth * sceneWorld.diagonal();
}

FrameRenderer::FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height,
                             const RendererOptions& options)
    : scene_(scene),
      width_(width),
      height_(height),
      capabilities_(capabilitiesFor(options)),
      tessellationLimit_(tessellationLimit(capabilities_, scene.maxPatchTriangles)),
      fullTriangles_(countFullTriangles(scene)),
      buffers_(scene),
      targets_(width, height),
      map_(visibility::mapLayout(width, height), &targets_.depth),
      pyramid_(visibility::mapLayout(width, height), capabilities_),
      visibility_(buffers_.objectCount(), options.importance),
      lists_(scene),
      early_(scene, gpu::kMarkEarly, listOptions(scene, options)),
      late_(scene, gpu::kMarkLate, listOptions(scene, options)),
      draw_(capabilities_),
      views_(scene) {}

FrameRenderer::Targets::Targets(std::uint32_t width, std::uint32_t height)
    : color(GL_TEXTURE_2D, GL_SRGB8_ALPHA8, {width, height, 1, 1}, "frame colour"),
      depth(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {width, height, 1, 1}, "frame depth"),
      id(GL_TEXTURE_2D, GL_R32UI, {width, height, 1, 1}, "object numbers"),
      frame(color, &depth, "frame"),
      view(color, nullptr, "view"),
      ids(id, &depth, "object numbers"),
      counted(color, &depth, "frame and item buffer", &id) {
  id.setSampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);  // integers are not filtered
}

void FrameRenderer::resize(std::uint32_t width, std::uint32_t height) {
  targets_ = Targets(width, height);
  map_.resize(visibility::mapLayout(width, height), &targets_.depth);
  pyramid_.resize(visibility::mapLayout(width, height));
  views_.resize();
  width_ = width;
  height_ = height;
  resetHistory();
}

void FrameRenderer::render(const FrameOptions& options, const scene::Camera& cullCamera,
                           const scene::Camera& drawCamera) noexcept {
  timer_.beginFrame();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  setViews(options, cullCamera, drawCamera);
  const bool twoPhases = options.cullMode == gpu::kCullHiz;
  {
    const gl::PassTimer::Scope pass(timer_, "classify");
    visibility_.classify(buffers_.bindings());
  }
  if (twoPhases || usesMap(options.cullMode)) findOccluded(options);
  buildList(late_, "late list");
  if (!options.skipDraw || counting_) drawFrame(options);
  const gl::PassTimer::Scope pass(timer_, "count");
  statistics_.endFrame(buffers_.bindings(), visibility_, cullView_,
                       twoPhases || usesMap(options.cullMode) ? &early_ : nullptr, late_);
}

void FrameRenderer::setViews(const FrameOptions& options, const scene::Camera& cullCamera,
                             const scene::Camera& drawCamera) {
  const float aspect = static_cast<float>(width_) / static_cast<float>(height_);
  const glm::vec3 eye = cullCamera.positionWorld();
  cullView_.clipFromWorld = scene::clipFromWorld(cullCamera, aspect);
  cullView_.cameraWorld = glm::vec4(eye, cullCamera.zNear);
  cullView_.viewportWidth = width_;
  cullView_.viewportHeight = height_;
  cullView_.objectCount = buffers_.objectCount();
  cullView_.cullMode = options.cullMode;
  cullView_.lodRule = options.lodRule;
  cullView_.detail = options.detail;
  cullView_.analyse =
      options.lodRule == gpu::kLodLinear || options.lodRule == gpu::kLodLvError || options.view == gpu::kViewLv ? 1 : 0;
  cullView_.mapLevels = map_.layout().levels;
  cullView_.occluderDistance =
      options.occluderDistance ? *options.occluderDistance : automaticOccluderDistance(eye, scene_.boundsWorld);
  cullView_.cullThreshold = options.cullThreshold;
  cullView_.maxTessellation = std::min(options.maxTessellation, tessellationLimit_);
  cullView_.focalPixels = scene::focalPixels(cullCamera, height_);
  cullView_.tau = options.tau;
  cullView_.occluderTau =
      options.occluderTau.value_or(options.cullMode == gpu::kCullHomDepth ? kDefaultOccluderTau : 0.0F);
  cullView_.minPixels = options.minPixels;
  cullView_.lvMeasure = options.lvMeasure;
  cullView_.relax = options.relax;
  cullView_.calm = options.calm ? 1 : 0;
  cullView_.hysteresis = options.hysteresis;
  cullView_.fadeFrames = std::min(options.fadeFrames, gpu::kMaxFadeFrames);
  cullView_.measureCover = options.view == gpu::kViewCoverage || options.view == gpu::kViewHoles ? 1 : 0;
  const bool wantsCounts = cullView_.analyse != 0 && options.lvMeasure == gpu::kLvPixels;
  counting_ = wantsCounts && countAge_ + 1 >= kCountInterval;
  countAge_ = counting_ ? 0 : wantsCounts ? countAge_ + 1 : kCountInterval;
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
  drawView_.depthGuard = 0.0F;
  drawView_.fadeFrames = cullView_.fadeFrames;
}

void FrameRenderer::buildList(visibility::DrawList& list, const char* name) {
  const gl::PassTimer::Scope pass(timer_, name);
  lists_.build(list, buffers_.bindings(), visibility_.decided());
}

void FrameRenderer::findOccluded(const FrameOptions& options) {
  buildList(early_, "early list");
  if (options.cullMode == gpu::kCullHiz) {
    drawEarly();
  } else {
    drawOccluders();
    const gl::PassTimer::Scope pass(timer_, "reduce map");
    map_.reduce();
  }
  if (options.cullMode != gpu::kCullHom) {
    const gl::PassTimer::Scope pass(timer_, "depth pyramid");
    pyramid_.build(targets_.depth, options.cullMode == gpu::kCullHiz ? visibility::DepthSource::kAll
                                                                     : visibility::DepthSource::kCovered);
  }
  const gl::PassTimer::Scope pass(timer_, "analyse");
  visibility_.analyse(buffers_.bindings(), options.cullMode, {&map_, &pyramid_, &targets_.depth});
}

void FrameRenderer::drawOccluders() {
  const gl::PassTimer::Scope pass(timer_, "occluders");
  const bool withDepth = cullView_.cullMode == gpu::kCullHomDepth;
  gpu::DrawView view = drawView_;
  view.clipFromWorld = cullView_.clipFromWorld;
  view.cameraWorld = cullView_.cameraWorld;
  view.depthGuard = withDepth ? cullView_.occluderTau / cullView_.focalPixels : 0.0F;
  draw_.setView(view);
  map_.beginOccluders(withDepth);
  if (withDepth) glEnable(GL_DEPTH_TEST);
  draw_.draw(DrawKind::kOpacity, DrawPart::kOpaque, cullView_.detail, buffers_, early_, visibility_.decided());
  glDisable(GL_DEPTH_TEST);
}

void FrameRenderer::beginTarget(const gl::Framebuffer& target) {
  target.bind(width_, height_);
  glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, kBackground.data());
  if (target.id() == targets_.counted.id()) glClearNamedFramebufferuiv(target.id(), GL_COLOR, 1, kNoObject.data());
  glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &kFarDepth);
}

void FrameRenderer::setCullingCamera() {
  gpu::DrawView view = drawView_;
  view.clipFromWorld = cullView_.clipFromWorld;
  view.cameraWorld = cullView_.cameraWorld;
  draw_.setView(view);
}

void FrameRenderer::drawEarly() {
  const gl::PassTimer::Scope pass(timer_, "early draw");
  setCullingCamera();
  glEnable(GL_FRAMEBUFFER_SRGB);  // before the clear: it converts the background too
  beginTarget(counting_ ? targets_.counted : targets_.frame);
  glEnable(GL_DEPTH_TEST);
  draw_.draw(DrawKind::kShaded, DrawPart::kOpaque, cullView_.detail, buffers_, early_, visibility_.decided());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void FrameRenderer::drawObjects(const gl::Framebuffer& target, bool earlyIsThere) {
  const bool twoPhases = cullView_.cullMode == gpu::kCullHiz;
  const auto draw = [&](DrawPart part, const visibility::DrawList& list) {
    draw_.draw(DrawKind::kShaded, part, cullView_.detail, buffers_, list, visibility_.decided());
  };
  target.bind(width_, height_);
  if (!earlyIsThere) beginTarget(target);
  glEnable(GL_DEPTH_TEST);
  if (twoPhases && !earlyIsThere) draw(DrawPart::kOpaque, early_);
  draw(DrawPart::kOpaque, late_);
  if (twoPhases) draw(DrawPart::kBlended, early_);
  draw(DrawPart::kBlended, late_);
  glDisable(GL_DEPTH_TEST);
}

void FrameRenderer::drawFrame(const FrameOptions& options) {
  const bool twoPhases = cullView_.cullMode == gpu::kCullHiz;
  const bool frozen = cullView_.clipFromWorld != drawView_.clipFromWorld;
  const bool showsCover = options.view == gpu::kViewOcclusion;
  glEnable(GL_FRAMEBUFFER_SRGB);
  if (counting_) {
    // Pixels count as the culling camera sees them.
    {
      const gl::PassTimer::Scope pass(timer_, twoPhases ? "late draw" : "draw");
      setCullingCamera();
      drawObjects(targets_.counted, twoPhases);
    }
    const gl::PassTimer::Scope pass(timer_, "count pixels");
    visibility_.countPixels(targets_.id);
  }
  if (showsCover) {
    const gl::PassTimer::Scope pass(timer_, "view");
    draw_.setView(drawView_);
    targets_.view.bind(width_, height_);
    twoPhases ? draw_.drawPyramid(pyramid_, targets_.depth) : draw_.drawMap(map_);
  } else if (!counting_ || frozen) {
    const gl::PassTimer::Scope pass(timer_, twoPhases ? "late draw" : "draw");
    draw_.setView(drawView_);
    drawObjects(targets_.frame, twoPhases && !frozen);
  }
  drawView(options, frozen);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void FrameRenderer::drawView(const FrameOptions& options, bool frozen) {
  const bool addsBoxes = options.boxes && !frozen;
  if (options.view < gpu::kViewWireframe && !addsBoxes) return;
  const gl::PassTimer::Scope pass(timer_, options.view < gpu::kViewWireframe ? "boxes" : "view");
  const DrawnFrame frame{
      drawView_, cullView_.cullMode == gpu::kCullHiz, &targets_.frame, &targets_.view, &early_, &late_, &visibility_};
  views_.draw(frame, draw_, buffers_, lists_);
  if (!addsBoxes) return;
  draw_.setView(drawView_);
  targets_.view.bind(width_, height_);
  draw_.drawBoxes(buffers_.objectCount(), visibility_.decided());
}

void FrameRenderer::renderCover() noexcept {
  counting_ = false;
  if (cullView_.cullMode == gpu::kCullHiz) drawEarly();
  if (usesMap(cullView_.cullMode)) drawOccluders();
}

void FrameRenderer::renderIds() noexcept {
  const bool twoPhases = cullView_.cullMode == gpu::kCullHiz;
  draw_.setView(drawView_);
  targets_.ids.bind(width_, height_);
  glClearNamedFramebufferuiv(targets_.ids.id(), GL_COLOR, 0, kNoObject.data());
  glClearNamedFramebufferfv(targets_.ids.id(), GL_DEPTH, 0, &kFarDepth);
  glEnable(GL_DEPTH_TEST);
  for (const DrawPart part : {DrawPart::kOpaque, DrawPart::kBlended}) {
    if (twoPhases) draw_.draw(DrawKind::kId, part, cullView_.detail, buffers_, early_, visibility_.decided());
    draw_.draw(DrawKind::kId, part, cullView_.detail, buffers_, late_, visibility_.decided());
  }
  glDisable(GL_DEPTH_TEST);
}

void FrameRenderer::setTransforms(std::uint32_t first, std::span<const gpu::Transform> transforms) {
  JAL_CHECK(first <= buffers_.transformCount());
  JAL_CHECK(transforms.size() <= buffers_.transformCount() - first);
  buffers_.transforms().write(sizeof(gpu::Transform) * first, std::as_bytes(transforms));
}

std::optional<FrameStatistics> FrameRenderer::statisticsOf(const std::optional<visibility::FrameRecord>& record) const {
  if (!record) return std::nullopt;
  const bool early = record->view.cullMode == gpu::kCullHiz || usesMap(record->view.cullMode);
  const std::uint64_t dropped =
      record->late[gpu::kCountDropped] + std::uint64_t{early ? record->early[gpu::kCountDropped] : 0};
  FrameStatistics statistics = makeStatistics(record->counters, record->view, fullTriangles_, dropped);
  statistics.frame = record->frame;
  const std::uint32_t first = record->view.detail == gpu::kDetailTessellation ? gpu::kListsPerDetail : 0;
  for (std::uint32_t list = first; list < first + gpu::kListsPerDetail; ++list)
    statistics.draws += record->late[list] + (record->view.cullMode == gpu::kCullHiz ? record->early[list] : 0);
  return statistics;
}

std::optional<FrameStatistics> FrameRenderer::latestStatistics() {
  return statisticsOf(statistics_.latest());
}

FrameStatistics FrameRenderer::readStatistics() {
  return statisticsOf(statistics_.finish()).value_or(FrameStatistics{});
}

ObjectReadout FrameRenderer::readObject(std::uint32_t index) const {
  JAL_CHECK(index < buffers_.objectCount());
  return {visibility_.states().read<gpu::ObjectState>(1, sizeof(gpu::ObjectState) * index)[0],
          visibility_.boxes().read<gpu::ScreenBox>(1, sizeof(gpu::ScreenBox) * index)[0],
          visibility_.marks().read<gpu::uint>(1, sizeof(gpu::uint) * index)[0],
          visibility_.pixelCounts().read<gpu::uint>(1, sizeof(gpu::uint) * index)[0]};
}

std::vector<gpu::ObjectState> FrameRenderer::readStates() const {
  return visibility_.states().read<gpu::ObjectState>(buffers_.objectCount());
}

std::vector<gpu::ScreenBox> FrameRenderer::readBoxes() const {
  return visibility_.boxes().read<gpu::ScreenBox>(buffers_.objectCount());
}

std::vector<gpu::uint> FrameRenderer::readMarks() const {
  return visibility_.marks().read<gpu::uint>(buffers_.objectCount());
}

std::vector<gpu::uint> FrameRenderer::readPixelCounts() const {
  return visibility_.pixelCounts().read<gpu::uint>(buffers_.objectCount());
}

}  // namespace jalousie::render
