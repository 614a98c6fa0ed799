// One step of the viewer: events, scenes, interface; and what is written at the end.
#include "app/view/viewer.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "app/view/action_table.h"
#include "app/view/clock.h"
#include "app/view/frame_graph.h"
#include "app/view/help_window.h"
#include "app/view/inspection_window.h"
#include "app/view/object_window.h"
#include "app/view/overlay.h"
#include "app/view/path_window.h"
#include "app/view/picture_overlays.h"
#include "asset/image_io.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr double kMessageSeconds = 6.0;
constexpr double kIdleSeconds = 0.1;
constexpr double kFlickerIdleSeconds = 0.02;
/// Longest time that counts as one step, so that a slow frame does not throw the camera far away.
constexpr double kMostStepSeconds = 0.25;

/// Modifiers of an event without locks.
int plainMods(int mods) {
  return mods & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
}

}  // namespace

Viewer::Viewer(platform::Window& window, const ViewOptions& options)
    : options_(options), parts_(window, options_), select_(options.select) {
  while (isScript() && parts_.documents.loading())  // a script gets no frames without its scenes
    loadNext();
  lastStep_ = secondsNow();
}

bool Viewer::done() const {
  return parts_.window.shouldClose() || (isScript() && framesDone_ >= *options_.frames);
}

bool Viewer::idle() const {
  return !parts_.redraw.needsScenes() && !parts_.redraw.needsInspection() && !parts_.state.playing &&
         !parts_.state.recording && !parts_.documents.loading();
}

void Viewer::step() {
  const bool waits = idle() && !parts_.redraw.needsInterface() && !isScript();
  waits ? glfwWaitEventsTimeout(parts_.state.flicker ? kFlickerIdleSeconds : kIdleSeconds) : glfwPollEvents();
  parts_.window.framebufferSize(width_, height_);
  const double seconds = std::min(secondsNow() - lastStep_, kMostStepSeconds);
  lastStep_ = secondsNow();
  parts_.documents.watch();
  if (width_ == 0 || height_ == 0) {  // minimised: there is nothing to draw into
    parts_.input.take();
    parts_.navigation.endDrag();
    glfwWaitEventsTimeout(kIdleSeconds);
    ++framesDone_;
    return;
  }
  parts_.pictures.resize(width_, height_);
  parts_.interface.begin();
  handleEvents();
  if (!parts_.interface.wantsKeys()) parts_.navigation.fly(seconds, parts_.input);
  parts_.pictures.flicker();
  parts_.player.step(seconds, framesDone_);
  parts_.redraw.interfaceFrameDone();
  renderScenes();
  parts_.pictures.compose();
  drawInterface();
  parts_.pictures.canvas().show();
  glfwSwapBuffers(parts_.window.handle());
  showTitle();
  parts_.outputs.windowDrawn();
  parts_.recorder.step();
  ++framesDone_;
  if (parts_.documents.loading()) loadNext();  // after a frame that shows the notice
}

void Viewer::handleEvents() {
  for (const InputEvent& event : parts_.input.take()) {
    parts_.redraw.interfaceChanged();
    handleEvent(event);
  }
}

void Viewer::handleEvent(const InputEvent& event) {
  const bool forInterface = parts_.interface.wantsPointer();
  switch (event.kind) {
    case InputEvent::Kind::kKey:
      return handleKey(event);
    case InputEvent::Kind::kButton:
      if (event.pressed && !forInterface) parts_.navigation.press(event);
      if (event.pressed) return;
      if (const auto click = parts_.navigation.release(event)) parts_.selection.pick(*click);
      return;
    case InputEvent::Kind::kMove:
      return parts_.navigation.moveTo(event.at);
    case InputEvent::Kind::kWheel:
      if (!forInterface) parts_.navigation.wheel(event.at.y, parts_.input);
      return;
    case InputEvent::Kind::kFocusLost:
      return parts_.navigation.endDrag();
    case InputEvent::Kind::kDrop:
      return parts_.documents.open(event.files);
  }
}

void Viewer::handleKey(const InputEvent& event) {
  if (!event.pressed || parts_.interface.wantsKeys()) return;
  const int mods = plainMods(event.mods);
  for (const Binding& binding : bindings())
    if (binding.key == event.code && binding.mods == mods) return perform(binding.action, parts_);
  if (event.code < GLFW_KEY_1 || event.code > GLFW_KEY_9) return;
  const auto bookmark = static_cast<std::size_t>(event.code - GLFW_KEY_1);
  if (mods == 0) parts_.cameras.goToBookmark(bookmark);
  if (mods == GLFW_MOD_CONTROL && parts_.cameras.setBookmark(bookmark))
    parts_.messages.attempt([&] { keepSettings(); });
}

void Viewer::renderScenes() {
  parts_.selection.leaveHiddenSide();
  const bool moves = parts_.state.playing || parts_.state.recording || isScript();
  if (!parts_.redraw.needsScenes() && !moves) {
    if (parts_.redraw.needsInspection()) inspect();
    return;
  }
  parts_.pictures.render();
  parts_.redraw.sceneFrameDone();
  const bool last = isScript() && framesDone_ + 1 >= *options_.frames;
  const bool settled = !parts_.redraw.needsScenes() && !parts_.state.playing;
  if (parts_.redraw.needsInspection() && (last || settled)) inspect();
}

void Viewer::inspect() {
  if (parts_.state.settings.objects) parts_.objects.update();
  parts_.selection.inspect();
  if (std::exchange(framesSelection_, false) && parts_.state.inspection) parts_.cameras.frame();
}

void Viewer::drawInterface() {
  drawPictureOverlays();
  const PanelResult result = drawWindows();
  parts_.pictures.canvas().bind();
  glDisable(GL_FRAMEBUFFER_SRGB);
  glUseProgram(0);  // the backend restores the program in use, which may have been deleted with its document
  parts_.interface.end();
  applyPanel(result);
}

void Viewer::drawPictureOverlays() {
  for (std::size_t i = 0; i < parts_.documents.size(); ++i)
    drawOverlays(parts_.documents, i, parts_.state, parts_.interface.scale());
  const Region whole{0.0F, 0.0F, static_cast<float>(width_), static_cast<float>(height_)};
  if (parts_.documents.empty())
    drawNotice(whole, "No file", "Drop a glTF or GLB file here, or name one on the command line.");
  const ViewState& state = parts_.state;
  if (!state.shaderError.empty())
    drawNotice(whole, "A shader does not build. The last working programs stay in use.", state.shaderError);
  if (!state.message.empty() && secondsNow() - state.messageSeconds < kMessageSeconds)
    drawMessage(whole, state.message);
}

PanelResult Viewer::drawWindows() {
  ViewState& state = parts_.state;
  PanelResult result;
  PanelFacts facts{parts_.window.capabilities().renderer, command(0), width_, height_, {}};
  for (std::size_t i = 0; i < parts_.documents.size(); ++i)
    facts.documents.push_back(parts_.documents[i].file().filename().string());
  state.freeLeft = state.coveredRight = 0.0F;
  if (state.settings.panel) drawPanel(state, parts_.documents.current(), facts, result);
  if (state.settings.graph && drawFrameGraph(state.history)) result.actions.push_back(Action::kSaveFrames);
  if (const Document* document = parts_.documents.current(); document != nullptr && state.settings.panel)
    result.path = drawPath(*document, state.playing);
  if (state.settings.objects)
    result.objects = drawObjects(parts_.objects.table(), state.selection, objectRows_, &state.settings.objects);
  if (state.inspection) {
    const int side = state.selection ? state.selection->side : 0;
    state.coveredRight = drawInspection(*state.inspection, state.configurations[static_cast<std::size_t>(side)].active);
  }
  if (state.help) drawHelp(&state.help);
  return result;
}

void Viewer::applyPanel(const PanelResult& result) {
  bool changed = result.camerasChanged || result.layoutChanged;
  if (result.configurationsChanged)
    for (Configuration& configuration : parts_.state.configurations)
      changed |= configuration.update();
  if (changed) parts_.redraw.scenesChanged();
  if (result.path.frame) parts_.player.goTo(*result.path.frame);
  if (result.path.toggle) parts_.player.toggle();
  if (!result.open.empty()) parts_.documents.open({result.open});
  applyObjects(result.objects);
  for (const Action action : result.actions)
    perform(action, parts_);
  if (result.resize)
    glfwSetWindowSize(parts_.window.handle(), static_cast<int>(result.resize->x), static_cast<int>(result.resize->y));
  if (result.saveFigures) parts_.outputs.saveFigures();
}

void Viewer::applyObjects(const ObjectWindowResult& result) {
  if (result.select) parts_.selection.select(parts_.state.current, *result.select);
  if (result.toggle) parts_.objects.toggle(*result.toggle);
  if (result.isolate) parts_.objects.isolate(*result.isolate);
  framesSelection_ = framesSelection_ || result.frame;  // its box is known when it has been inspected
  for (const Action action : result.actions)
    perform(action, parts_);
}

void Viewer::showTitle() {
  const Document* document = parts_.documents.current();
  const std::string title = document == nullptr ? "jalousie" : "jalousie - " + document->file().filename().string();
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(parts_.window.handle(), title.c_str());
}

void Viewer::loadNext() {
  const std::optional<std::size_t> loaded = parts_.documents.loadNext();
  if (!loaded) return;
  const Document& document = parts_.documents[*loaded];
  std::error_code failed;
  if (!isScript() && document.error().empty())
    addRecent(parts_.state.settings, std::filesystem::absolute(document.file(), failed).string());
  if (loaded == 0 && select_) parts_.selection.select(0, *std::exchange(select_, std::nullopt));
}

void Viewer::keepSettings() {
  if (isScript()) return;  // a script leaves the settings alone
  ViewSettings& settings = parts_.state.settings;
  settings.layout = parts_.interface.layout();
  int width = 0;
  int height = 0;
  glfwGetWindowSize(parts_.window.handle(), &width, &height);
  if (width > 0 && height > 0) {
    settings.width = static_cast<std::uint32_t>(width);
    settings.height = static_cast<std::uint32_t>(height);
  }
  mergeBookmarks(settings, loadSettings(settingsFolder()));  // another viewer may have set some meanwhile
  saveSettings(settings, settingsFolder());
}

void Viewer::finish() {
  std::vector<Error> failures;
  if (isScript()) {  // otherwise the user has read them in the window
    failures = parts_.messages.failures();
    for (std::size_t i = 0; i < parts_.documents.size(); ++i)
      if (const Document& document = parts_.documents[i]; !document.error().empty())
        failures.emplace_back(document.errorCode(), document.error());
  }
  const bool writes = failures.empty();
  // Every step is tried, whatever happened before; the first failure is reported.
  const auto attempt = [&](bool wanted, const std::function<void()>& task) {
    try {
      if (wanted) task();
    } catch (const Error& error) {
      failures.push_back(error);
    }
  };
  attempt(true, [&] { keepSettings(); });
  attempt(parts_.state.recording, [&] { parts_.recorder.save(); });
  attempt(writes && !options_.screenshot.empty(),
          [&] { asset::savePng(options_.withInterface ? captureWithInterface() : capture(), options_.screenshot); });
  attempt(writes && !options_.json.empty(), [&] { parts_.outputs.writeFigures(options_.json); });
  if (!failures.empty()) throw Error(failures.front());
}

}  // namespace jalousie::app
