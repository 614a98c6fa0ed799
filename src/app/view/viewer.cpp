// The frame of the window: layout, scenes, overlays, interface.
#include "app/view/viewer.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/configurations.h"
#include "app/option_values.h"
#include "app/view/command_text.h"
#include "app/view/frame_graph.h"
#include "app/view/help_window.h"
#include "app/view/inspection_window.h"
#include "app/view/legend.h"
#include "app/view/overlay.h"
#include "core/error.h"
#include "gl/shader_source.h"

namespace jalousie::app {
namespace {

/// Until two phases have settled and pixels are counted; and, with calm, until LV has come to rest: four seconds of a
/// moving picture (docs/lod_selection.md).
constexpr std::uint32_t kSettleFrames = 8;
constexpr std::uint32_t kCalmFrames = 128;
constexpr double kMessageSeconds = 6.0;
constexpr double kIdleSeconds = 0.1;

ViewState startState(const ViewOptions& options) {
  ViewState state;
  if (!options.frames) state.settings = loadSettings(settingsFolder());  // a script depends on its options alone
  state.outputs = options.outputs;
  state.divider = options.divider;
  state.playing = options.play;
  state.split = options.split.has_value();
  for (Configuration& configuration : state.configurations)
    configuration.wanted = options.render;
  if (options.split) state.configurations[1].wanted = viewOptionsOf(*options.split);
  for (Configuration& configuration : state.configurations)
    configuration.update();
  return state;
}

}  // namespace

Viewer::Viewer(platform::Window& window, const ViewOptions& options)
    : window_(window),
      options_(options),
      state_(startState(options)),
      input_(window.handle()),
      interface_(window.handle(), options.scale, state_.settings.layout),
      shaderWatch_(options.shaders, /*recursive=*/true),
      settingsFolder_(settingsFolder()) {
  pathStart_ = pathSeconds_ =
      static_cast<double>(options.render.frame.value_or(0.0F)) / static_cast<double>(scene::kPathRate);
  gl::setShaderFolder(options.shaders);
  for (const std::filesystem::path& file : expandFolders(options.files))
    open(file);
  state_.current = 0;
  if (options.frames)  // a script wants the scene, not the wait
    while (loading())
      loadNext();
  lastStep_ = now();
}

Viewer::~Viewer() {
  gl::setShaderFolder({});
}

double Viewer::now() const {
  return glfwGetTime();
}

bool Viewer::done() const {
  return quit_ || window_.shouldClose() || (options_.frames && framesDone_ >= *options_.frames);
}

void Viewer::touch() {
  if (state_.sides() == 1) {
    if (state_.selection) state_.selection->side = 0;
    for (const auto& document : documents_)
      document->forgetFailure(1);
  }
  dirtyFrames_ = kSettleFrames;
  for (const Configuration& configuration : state_.configurations)
    if (configuration.active.frameOptions.calm) dirtyFrames_ = kCalmFrames;
  wakeFrames_ = 3;
  inspectSoon_ = state_.selection.has_value();
}

void Viewer::step() {
  const bool waits = idle() && wakeFrames_ == 0 && !options_.frames;
  waits ? glfwWaitEventsTimeout(state_.flicker ? 0.02 : kIdleSeconds) : glfwPollEvents();
  window_.framebufferSize(width_, height_);
  const double seconds = std::min(now() - lastStep_, 0.25);
  lastStep_ = now();
  watchFiles();
  if (width_ == 0 || height_ == 0) {  // minimised: nothing to draw into
    input_.take();
    drag_ = Drag::kNone;
    glfwWaitEventsTimeout(kIdleSeconds);
    ++framesDone_;
    return;
  }
  layOut();
  interface_.begin();
  handleEvents();
  flyByKeys(seconds);
  playPath(seconds);
  if (wakeFrames_ > 0) --wakeFrames_;
  renderScenes();
  compose();
  drawInterface();
  canvas_.show();
  glfwSwapBuffers(window_.handle());
  showTitle();
  if (screenshotSoon_) screenshot(/*withInterface=*/true);
  recordPose();
  ++framesDone_;
  if (loading()) loadNext();  // the window has said so
}

void Viewer::showTitle() {
  const Document* document = current();
  const std::string title = document == nullptr ? "jalousie" : "jalousie - " + document->file().filename().string();
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_.handle(), title.c_str());
}

void Viewer::layOut() {
  if (canvas_.width() == width_ && canvas_.height() == height_) return;
  canvas_.resize(width_, height_);
  touch();
}

Region Viewer::region(std::size_t document) const {
  const std::size_t count = std::max<std::size_t>(documents_.size(), 1);
  const std::size_t from = width_ * document / count;
  const std::size_t to = width_ * (document + 1) / count;
  return {static_cast<float>(from), 0.0F, static_cast<float>(to - from), static_cast<float>(height_)};
}

RenderOptions Viewer::optionsFor(std::size_t document, int side) const {
  RenderOptions options = state_.configurations[static_cast<std::size_t>(side)].active;
  documents_[document]->camera.applyTo(options);
  options.scene = documents_[document]->file();
  options.width = std::max(static_cast<std::uint32_t>(region(document).width), 1U);
  options.height = std::max(height_, 1U);
  options.repeat = 1;
  return options;
}

std::optional<RenderCameras> Viewer::camerasFor(std::size_t document, int side) {
  Side* shown = documents_[document]->side(side);
  if (shown == nullptr) return std::nullopt;
  try {
    return renderCameras(optionsFor(document, side), shown->scene(), documents_[document]->path());
  } catch (const Error& error) {
    if (state_.message != error.what()) say(error.what());
    return std::nullopt;
  }
}

std::string Viewer::command(int side, const std::string& output, bool absolute) const {
  if (state_.current >= documents_.size()) return {};
  RenderOptions options = optionsFor(state_.current, side);
  const Configuration& configuration = state_.configurations[static_cast<std::size_t>(side)];
  if (configuration.refusal.empty()) options.lv = configuration.wanted.lv;  // automatic stays unsaid
  for (std::filesystem::path* path : {&options.scene, &options.path, &options.importance}) {
    std::error_code failed;
    if (absolute && !path->empty()) *path = std::filesystem::absolute(*path, failed);
  }
  return renderCommand(options, output);
}

void Viewer::renderScenes() {
  if (dirtyFrames_ == 0 && !state_.playing && !state_.recording && !options_.frames) {
    if (inspectSoon_) inspect();
    return;
  }
  for (std::size_t i = 0; i < documents_.size(); ++i)
    renderDocument(i);
  if (dirtyFrames_ > 0) --dirtyFrames_;
  const bool last = options_.frames && framesDone_ + 1 >= *options_.frames;
  if (inspectSoon_ && (last || (dirtyFrames_ == 0 && !state_.playing))) inspect();
}

void Viewer::renderDocument(std::size_t index) {
  Document& document = *documents_[index];
  for (int side = 0; side < state_.sides(); ++side) {
    const RenderOptions options = optionsFor(index, side);
    Side* scene = document.prepare(side, options);
    if (scene == nullptr) continue;
    render::FrameRenderer& renderer = scene->renderer();
    renderer.timer().setTiming(window_.capabilities().softwareRenderer ? gl::Timing::kWall : gl::Timing::kGpu);
    const std::optional<RenderCameras> cameras = camerasFor(index, side);
    if (!cameras) continue;
    renderer.render(options.frameOptions, cameras->cull, cameras->draw);
    if (index != state_.current || side != 0) continue;
    if (charted_ != &document) state_.history.clear();
    charted_ = &document;
    if (const auto statistics = renderer.latestStatistics())
      state_.history.add(makeSample(now(), renderer.timer().passes(), *statistics));
  }
}

void Viewer::compose() {
  canvas_.clear();
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const Region where = region(i);
    const auto left = static_cast<std::uint32_t>(where.x);
    const auto width = static_cast<std::uint32_t>(where.width);
    const bool flickersToB = state_.flicker && state_.flickerSide == 1;
    Side* a = documents_[i]->side(flickersToB ? 1 : 0);
    Side* b = state_.split && !state_.flicker ? documents_[i]->side(1) : nullptr;
    const std::uint32_t divider =
        b != nullptr ? static_cast<std::uint32_t>(std::lround(state_.divider * static_cast<float>(width))) : width;
    const auto fits = [&](Side* side) {
      return side != nullptr && side->renderer().width() == width && side->renderer().height() == height_;
    };
    if (fits(a)) canvas_.copy(a->renderer().color(), 0, left, divider);
    if (fits(b)) canvas_.copy(b->renderer().color(), divider, left + divider, width - divider);
  }
}

void Viewer::inspect() {
  inspectSoon_ = false;
  state_.inspection.reset();
  if (!state_.selection || state_.selection->document >= documents_.size()) return;
  const Selection& s = *state_.selection;
  Side* side = documents_[s.document]->side(s.side);
  if (side == nullptr || s.object >= side->scene().objects.size()) return;
  const RenderOptions options = optionsFor(s.document, s.side);
  const std::optional<RenderCameras> cameras = camerasFor(s.document, s.side);
  if (!cameras) return;
  state_.inspection = inspectObject(s.object, side->scene(), side->renderer(), options.frameOptions);
  side->renderer().render(options.frameOptions, cameras->cull, cameras->draw);
  wakeFrames_ = 3;
}

ImageRgba8 Viewer::capture() {
  if (canvas_.width() == 0) throw Error(ErrorCode::kUsage, "the window has no size, so there is no picture");
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    for (int side = 0; side < state_.sides(); ++side) {
      const RenderOptions options = optionsFor(i, side);
      Side* scene = documents_[i]->prepare(side, options);
      if (scene == nullptr) continue;
      captureFrame(options, scene->renderer(), window_.capabilities(),
                   renderCameras(options, scene->scene(), documents_[i]->path()));
    }
  }
  compose();
  return canvas_.read();
}

void Viewer::drawOverlays(std::size_t index) {
  Document& document = *documents_[index];
  const Region where = region(index);
  if (documents_.size() > 1) drawFileName(where, document.file().filename().string(), index == state_.current);
  if (!document.wasLoaded()) return drawNotice(where, document.file().filename().string(), "reading ...");
  if (!document.error().empty()) {
    drawNotice(where, document.file().filename().string(), document.error());
    if (document.side(0) == nullptr) return;
  }
  const RenderOptions options = optionsFor(index, state_.flicker ? state_.flickerSide : 0);
  Side* side = document.side(0);
  if (side == nullptr) return;
  const std::optional<RenderCameras> cameras = camerasFor(index, 0);
  if (!cameras) return;
  if (document.camera.frozen())
    drawFrustum(where, cameras->cull, cameras->draw,
                glm::length(cameras->cull.positionWorld() - document.boundsWorld().center()) +
                    0.5F * document.boundsWorld().diagonal());
  if (state_.inspection && state_.selection && state_.selection->document == index && !state_.playing)
    drawSelection(where, *state_.inspection, cameras->draw, document.camera.frozen());
  if (!state_.split || state_.flicker) return drawLegend(where, options);
  const Region right = where.rightOf(state_.divider);
  drawLegend(where.leftOf(state_.divider), options);
  drawLegend(right, optionsFor(index, 1));
  drawDivider(right, interface_.scale());
}

void Viewer::drawInterface() {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    drawOverlays(i);
  const Region whole{0.0F, 0.0F, static_cast<float>(width_), static_cast<float>(height_)};
  if (documents_.empty())
    drawNotice(whole, "No file", "Drop a glTF or GLB file here, or name one on the command line.");
  if (!state_.shaderError.empty())
    drawNotice(whole, "A shader does not build; the last good ones go on", state_.shaderError);
  if (!state_.message.empty() && now() - state_.messageSeconds < kMessageSeconds) drawMessage(whole, state_.message);
  PanelResult result;
  PanelFacts facts{window_.capabilities().renderer, command(0), width_, height_, {}};
  for (const auto& document : documents_)
    facts.documents.push_back(document->file().filename().string());
  if (state_.settings.panel) drawPanel(state_, current(), facts, result);
  if (state_.settings.graph) drawFrameGraph(state_.history);
  if (state_.inspection)
    drawInspection(
        *state_.inspection,
        state_.configurations[static_cast<std::size_t>(state_.selection ? state_.selection->side : 0)].active);
  if (state_.help) drawHelp(&state_.help);
  canvas_.bind();
  glDisable(GL_FRAMEBUFFER_SRGB);
  glUseProgram(0);  // the backend puts the program back that it found, and that may have gone with its document
  interface_.end();
  applyPanel(result);
}

void Viewer::applyPanel(const PanelResult& result) {
  bool changed = result.camerasChanged || result.layoutChanged;
  if (result.configurationsChanged)
    for (Configuration& configuration : state_.configurations)
      changed |= configuration.update();
  if (changed) touch();
  for (const Action action : result.actions)
    act(action);
  if (result.resize)
    glfwSetWindowSize(window_.handle(), static_cast<int>(result.resize->x), static_cast<int>(result.resize->y));
  if (!result.saveFigures) return;
  attempt([&] {
    const std::filesystem::path& said = state_.configurations[0].wanted.json;
    const std::filesystem::path file = said.empty() ? freshOutput("jalousie-figures", ".json") : said;
    writeJson(file);
    say(file.string());
  });
}

}  // namespace jalousie::app
