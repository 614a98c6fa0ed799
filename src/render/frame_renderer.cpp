// classify -> the mode's method decides -> late list -> draw -> count.
#include "render/frame_renderer.h"

#include "core/check.h"
#include "render/frame_parts.h"
#include "render/memory_needs.h"

namespace jalousie::render {

FrameRenderer::FrameRenderer(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height,
                             const RendererOptions& options)
    : parts_(std::make_unique<FrameParts>(scene, width, height, options,
                                          options.shaders != nullptr ? *options.shaders : gl::ShaderLibrary())) {}

FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer& FrameRenderer::operator=(FrameRenderer&&) noexcept = default;

void FrameRenderer::prepare(const FrameOptions& options) {
  parts_->methods[options.cullMode].allocate();
}

void FrameRenderer::render(const FrameOptions& options, const scene::Camera& cullCamera,
                           const scene::Camera& drawCamera) noexcept {
  FrameParts& parts = *parts_;
  prepare(options);
  CullMethod& method = parts.methods[options.cullMode];
  parts.timer.beginFrame();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  parts.setViews(options, cullCamera, drawCamera);
  if (parts.motion) {
    const gl::PassTimer::Scope pass(parts.timer, "animate");
    parts.motion->play(options.seconds, parts.buffers);
  }
  method.prepare(parts.context);
  {
    const gl::PassTimer::Scope pass(parts.timer, "classify");
    parts.visibility.classify(parts.buffers.bindings());
  }
  method.decide(parts.context);
  parts.context.limitTriangles(parts.late);
  parts.context.buildList(parts.late, "late list");
  if (!options.skipDraw || parts.counting) parts.drawing.draw(options, method);
  const gl::PassTimer::Scope pass(parts.timer, "count");
  if (parts.cullView.triangleBudget > 0) parts.budget.movePrice(parts.visibility.decided(), parts.late);
  parts.statistics.endFrame(parts.buffers.bindings(), parts.visibility.decided(), parts.cullView,
                            rowOf(options.cullMode).testsOcclusion ? &parts.early : nullptr, parts.late);
  const std::uint64_t frame = parts.statistics.frame();
  parts.queryRecords[frame % parts.queryRecords.size()] = {frame, parts.queryFigures};
}

void FrameRenderer::renderCover() noexcept {
  parts_->methods[parts_->cullMode].redrawCover(parts_->context);
}

void FrameRenderer::renderIds() noexcept {
  parts_->drawing.drawIds();
}

void FrameRenderer::renderLeftOutIds() noexcept {
  parts_->drawing.drawLeftOutIds();
}

void FrameRenderer::resize(std::uint32_t width, std::uint32_t height) {
  FrameParts& parts = *parts_;
  targetNeeds(width, height).require(parts.memory);
  parts.targets = Targets(width, height);
  parts.map.resize(visibility::mapLayout(width, height), &parts.targets.depth);
  parts.pyramid.resize(visibility::mapLayout(width, height));
  parts.methods.resize(width, height);
  parts.drawing.resize();
  resetHistory();
}

void FrameRenderer::setTransforms(std::uint32_t first, std::span<const gpu::Transform> transforms) {
  JAL_CHECK(first <= parts_->buffers.transformCount());
  JAL_CHECK(transforms.size() <= parts_->buffers.transformCount() - first);
  if (parts_->motion) parts_->motion->forget();
  parts_->buffers.noteMovement();
  parts_->buffers.transforms().write(sizeof(gpu::Transform) * first, std::as_bytes(transforms));
}

gl::Buffer& FrameRenderer::transforms() {
  parts_->buffers.shareTransforms();
  return parts_->buffers.transforms();
}

void FrameRenderer::resetHistory() {
  parts_->objects.forget();
  parts_->methods.forget();
  parts_->countAge = kCountInterval;
}

std::optional<FrameStatistics> FrameRenderer::latestStatistics() {
  return parts_->statisticsOf(parts_->statistics.latest());
}

FrameStatistics FrameRenderer::readStatistics() {
  return parts_->statisticsOf(parts_->statistics.finish()).value_or(FrameStatistics{});
}

ImageRgba8 FrameRenderer::readImage() const {
  return parts_->targets.frame.readRgba8(width(), height());
}

std::vector<float> FrameRenderer::readDepth() const {
  return parts_->targets.frame.readDepth(width(), height());
}

std::vector<std::uint32_t> FrameRenderer::readIds() const {
  return parts_->targets.ids.readRedInteger(width(), height());
}

ObjectReadout FrameRenderer::readObject(std::uint32_t index) const {
  JAL_CHECK(index < parts_->buffers.objectCount());
  const visibility::ObjectStore& objects = parts_->objects;
  return {objects.states.read<gpu::ObjectState>(1, sizeof(gpu::ObjectState) * index)[0],
          objects.boxes.read<gpu::ScreenBox>(1, sizeof(gpu::ScreenBox) * index)[0],
          objects.marks.read<gpu::uint>(1, sizeof(gpu::uint) * index)[0],
          objects.pixelCounts.read<gpu::uint>(1, sizeof(gpu::uint) * index)[0]};
}

Aabb FrameRenderer::readBounds(std::uint32_t index) const {
  JAL_CHECK(index < parts_->buffers.objectCount());
  const gpu::Object& object = parts_->scene.objects[index];
  const gpu::Transform transform =
      parts_->buffers.transforms().read<gpu::Transform>(1, sizeof(gpu::Transform) * object.transform)[0];
  const gpu::Chain chain = parts_->buffers.chains().read<gpu::Chain>(1, sizeof(gpu::Chain) * object.chain)[0];
  return transformed(scene::worldFromObject(transform),
                     {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
}

std::vector<gpu::ObjectState> FrameRenderer::readStates() const {
  return parts_->objects.states.read<gpu::ObjectState>(parts_->buffers.objectCount());
}

std::vector<gpu::ScreenBox> FrameRenderer::readBoxes() const {
  return parts_->objects.boxes.read<gpu::ScreenBox>(parts_->buffers.objectCount());
}

std::vector<gpu::uint> FrameRenderer::readMarks() const {
  return parts_->objects.marks.read<gpu::uint>(parts_->buffers.objectCount());
}

std::vector<gpu::uint> FrameRenderer::readPixelCounts() const {
  return parts_->objects.pixelCounts.read<gpu::uint>(parts_->buffers.objectCount());
}

void FrameRenderer::setTiming(Timing timing) {
  parts_->timer.setTiming(timing);
}
const std::vector<PassTime>& FrameRenderer::passTimes() {
  return parts_->timer.passes();
}
const gl::Texture& FrameRenderer::color() const {
  return parts_->targets.color;
}
const gpu::CullView& FrameRenderer::cullView() const {
  return parts_->cullView;
}
const visibility::OcclusionMapPass& FrameRenderer::map() const {
  return parts_->map;
}
const visibility::DepthPyramidPass& FrameRenderer::pyramid() const {
  return parts_->pyramid;
}
const visibility::DrawList& FrameRenderer::earlyList() const {
  return parts_->early;
}
const visibility::DrawList& FrameRenderer::lateList() const {
  return parts_->late;
}
std::uint32_t FrameRenderer::width() const {
  return parts_->targets.width;
}
std::uint32_t FrameRenderer::height() const {
  return parts_->targets.height;
}

}  // namespace jalousie::render
