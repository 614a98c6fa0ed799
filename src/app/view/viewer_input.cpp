// Keys, pointer, and what they do.
#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/view/viewer.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr float kRadiansPerPixel = 0.005F;
constexpr float kClickPixels = 4.0F;
constexpr float kDividerPixels = 7.0F;
constexpr float kSpeedPerStep = 1.25F;
/// Of the scene's diagonal, a second, at speed 1.
constexpr float kFlightShare = 0.1F;
constexpr int kFlightKeys[] = {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E};

/// Whether two scenes are so alike that one camera serves both: two bakes of one mesh, a scene before and after.
bool areAlike(const Aabb& a, const Aabb& b) {
  if (a.empty() || b.empty()) return false;
  const float larger = std::max(a.diagonal(), b.diagonal());
  return glm::length(a.center() - b.center()) <= 0.25F * larger &&
         std::min(a.diagonal(), b.diagonal()) >= 0.5F * larger;
}

int plainMods(int mods) {
  return mods & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
}

}  // namespace

void Viewer::handleEvents() {
  for (const InputEvent& event : input_.take()) {
    wakeFrames_ = 3;
    switch (event.kind) {
      case InputEvent::Kind::kKey:
        handleKey(event);
        break;
      case InputEvent::Kind::kButton:
        handleButton(event);
        break;
      case InputEvent::Kind::kMove:
        handleMove(event);
        break;
      case InputEvent::Kind::kWheel:
        handleWheel(event);
        break;
      case InputEvent::Kind::kFocusLost:
        drag_ = Drag::kNone;
        break;
      case InputEvent::Kind::kDrop:
        for (const std::filesystem::path& file : expandFolders(event.files))
          open(file);
        break;
    }
  }
}

void Viewer::handleKey(const InputEvent& event) {
  if (!event.pressed || interface_.wantsKeys()) return;
  const int mods = plainMods(event.mods);
  for (const Binding& binding : bindings())
    if (binding.key == event.code && binding.mods == mods) return act(binding.action);
  const bool number = event.code >= GLFW_KEY_1 && event.code <= GLFW_KEY_9;
  if (number && (mods == 0 || mods == GLFW_MOD_CONTROL))
    useBookmark(static_cast<std::size_t>(event.code - GLFW_KEY_1), mods == GLFW_MOD_CONTROL);
}

void Viewer::handleButton(const InputEvent& event) {
  pointer_ = event.at;
  if (!event.pressed) {
    const bool click = drag_ == Drag::kTurn && !dragged_;
    drag_ = Drag::kNone;
    if (click && event.code == GLFW_MOUSE_BUTTON_LEFT) pick(event.at);
    return;
  }
  if (interface_.wantsPointer()) return;
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (region(i).holds(event.at)) state_.current = i;
  const Region where = region(state_.current);
  const bool onDivider =
      state_.split && !state_.flicker &&
      std::abs(event.at.x - where.x - state_.divider * where.width) < kDividerPixels * interface_.scale();
  dragFrom_ = event.at;
  dragged_ = false;
  if (event.code == GLFW_MOUSE_BUTTON_RIGHT) drag_ = Drag::kLook;
  if (event.code == GLFW_MOUSE_BUTTON_MIDDLE) drag_ = Drag::kPan;
  if (event.code == GLFW_MOUSE_BUTTON_LEFT)
    drag_ = onDivider ? Drag::kDivider : (event.mods & GLFW_MOD_SHIFT) != 0 ? Drag::kPan : Drag::kTurn;
}

void Viewer::handleMove(const InputEvent& event) {
  const glm::vec2 by = event.at - pointer_;
  pointer_ = event.at;
  if (drag_ == Drag::kNone || by == glm::vec2(0.0F)) return;
  if (drag_ == Drag::kDivider) {
    const Region where = region(state_.current);
    state_.divider = std::clamp((event.at.x - where.x) / std::max(where.width, 1.0F), 0.0F, 1.0F);
    return;
  }
  if (!dragged_ && glm::length(event.at - dragFrom_) < kClickPixels * interface_.scale()) return;
  const glm::vec2 moved = dragged_ ? by : event.at - dragFrom_;
  dragged_ = true;
  if (current() == nullptr) return;
  const Pose pose = currentPose();
  if (drag_ == Drag::kTurn)
    movePose(orbited(pose, -kRadiansPerPixel * moved.x, kRadiansPerPixel * moved.y));
  else if (drag_ == Drag::kLook)
    movePose(turned(pose, -kRadiansPerPixel * moved.x, -kRadiansPerPixel * moved.y));
  else
    movePose(panned(pose, moved.x, -moved.y, scene::focalPixels(cameraOf(state_.current), height_)));
}

void Viewer::handleWheel(const InputEvent& event) {
  if (interface_.wantsPointer() || current() == nullptr) return;
  const bool flying = drag_ == Drag::kLook || std::any_of(std::begin(kFlightKeys), std::end(kFlightKeys),
                                                          [&](int key) { return input_.held(key); });
  if (!flying) return movePose(zoomed(currentPose(), event.at.y));
  state_.settings.speed =
      std::clamp(state_.settings.speed * std::pow(kSpeedPerStep, event.at.y), kLeastSpeed, kMostSpeed);
  say(fmt::format("speed {:.2f}", state_.settings.speed));
}

void Viewer::flyByKeys(double seconds) {
  if (current() == nullptr || interface_.wantsKeys()) return;
  if (input_.held(GLFW_KEY_LEFT_CONTROL) || input_.held(GLFW_KEY_RIGHT_CONTROL)) return;
  const auto axis = [&](int more, int less) {
    return static_cast<float>(input_.held(more)) - static_cast<float>(input_.held(less));
  };
  const glm::vec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S));
  if (direction == glm::vec3(0.0F)) return;
  const float diagonal = std::max(current()->boundsWorld().diagonal(), 1e-3F);
  movePose(
      moved(currentPose(), static_cast<float>(seconds) * kFlightShare * diagonal * state_.settings.speed * direction));
}

scene::Camera Viewer::cameraOf(std::size_t index) {
  const std::optional<RenderCameras> cameras = camerasFor(index, 0);
  return cameras ? cameras->draw : scene::frameBox(documents_[index]->boundsWorld(), 1.0F);
}

Pose Viewer::currentPose() {
  Document& document = *current();
  if (document.camera.pose) return *document.camera.pose;
  const scene::Camera camera = cameraOf(state_.current);
  return poseOf(camera, targetDistance(camera, document.boundsWorld()));
}

bool Viewer::follows(std::size_t document, std::size_t leader) const {
  return document == leader ||
         (state_.linked && areAlike(documents_[document]->boundsWorld(), documents_[leader]->boundsWorld()));
}

void Viewer::movePose(const Pose& pose) {
  if (!isUsable(pose)) return;
  state_.playing = false;
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    if (!follows(i, state_.current)) continue;
    documents_[i]->camera.pose = pose;
    documents_[i]->camera.frame.reset();
  }
  touch();
}

void Viewer::useBookmark(std::size_t number, bool set) {
  if (current() == nullptr) return;
  std::error_code failed;
  Bookmarks& marks = state_.settings.bookmarks[std::filesystem::absolute(current()->file(), failed).string()];
  if (set) {
    const Pose pose = currentPose();
    if (!isUsable(pose)) return;
    marks[number] = pose;
    say(fmt::format("bookmark {} set", number + 1));
    return attempt([&] { keepSettings(); });
  }
  if (!marks[number]) return say(fmt::format("no bookmark {}: Ctrl+{} sets it", number + 1, number + 1));
  movePose(*marks[number]);
}

void Viewer::cycle(const char* option, int step) {
  const RenderOption& row = renderOption(option);
  const auto& choice = std::get<ChoiceValue>(row.value);
  const auto count = static_cast<int>(choice.names.size());
  Configuration& configuration = state_.configurations[0];
  const RenderOptions before = configuration.wanted;
  const auto at = static_cast<int>(
      std::find(choice.names.begin(), choice.names.end(), choice.of(configuration.wanted)) - choice.names.begin());
  // The next one that goes with the other options.
  for (int i = 1; i <= count; ++i) {
    configuration.wanted = before;
    choice.of(configuration.wanted) = choice.names[static_cast<std::size_t>((at + (i * step) + i * count) % count)];
    configuration.update();
    if (configuration.refusal.empty()) break;
  }
  say(fmt::format("{} {}", row.label, choice.of(configuration.wanted)));
  touch();
}

void Viewer::freezeOrThaw() {
  CameraChoice& camera = current()->camera;
  if (camera.frozen()) {
    camera.freezeFrame.reset();
    camera.freezePose.reset();
    say("the culling camera follows again");
  } else {
    if (camera.frame || (!camera.pose && current()->pathFrames() > 0))
      camera.freezeFrame = camera.frame.value_or(0.0F);
    else
      camera.freezePose = currentPose();
    say("the culling camera is frozen: fly on");
  }
  touch();
}

void Viewer::pick(const glm::vec2& at) {
  state_.selection.reset();
  state_.inspection.reset();
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const Region where = region(i);
    if (!where.holds(at)) continue;
    const bool right = state_.split && at.x - where.x >= std::round(state_.divider * where.width);
    const int index = state_.flicker ? state_.flickerSide : right ? 1 : 0;
    Side* side = documents_[i]->side(index);
    if (side == nullptr) continue;
    render::FrameRenderer& renderer = side->renderer();
    renderer.renderIds();
    const std::vector<std::uint32_t> ids = renderer.readIds();
    const auto x = std::min(static_cast<std::uint32_t>(at.x - where.x), renderer.width() - 1);
    const auto y = renderer.height() - 1 - std::min(static_cast<std::uint32_t>(at.y), renderer.height() - 1);
    const std::uint32_t id = ids[static_cast<std::size_t>(y) * renderer.width() + x];
    if (id > 0) state_.selection = Selection{i, index, id - 1};
  }
  touch();
}

void Viewer::select(std::size_t document, int side, std::uint32_t object) {
  Side* made = documents_[document]->prepare(side, optionsFor(document, side));
  if (made == nullptr) return;
  const std::vector<gpu::Object>& objects = made->scene().objects;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
    if (objects[i].instance == object) state_.selection = Selection{document, side, i};
  if (!state_.selection)
    failures_.emplace_back(ErrorCode::kUsage, fmt::format("--select {}: there is no such object", object),
                           documents_[document]->file());
  touch();
}

void Viewer::act(Action action) {
  Document* document = current();
  switch (action) {
    case Action::kHelp:
      state_.help = !state_.help;
      return;
    case Action::kPanel:
      state_.settings.panel = !state_.settings.panel;
      return;
    case Action::kGraph:
      state_.settings.graph = !state_.settings.graph;
      return;
    case Action::kNextView:
      return cycle("--view", 1);
    case Action::kPreviousView:
      return cycle("--view", -1);
    case Action::kNextMode:
      return cycle("--mode", 1);
    case Action::kBoxes:
      state_.configurations[0].wanted.frameOptions.boxes ^= true;
      state_.configurations[0].update();
      return touch();
    case Action::kMapCoarser:
    case Action::kMapFiner: {
      std::uint32_t& level = state_.configurations[0].wanted.frameOptions.mapLevel;
      level = action == Action::kMapCoarser ? std::min(level + 1, 14U) : std::max(level, 1U) - 1;
      state_.configurations[0].update();
      return touch();
    }
    case Action::kSplit:
      state_.split = !state_.split;
      return touch();
    case Action::kFlicker:
      state_.flicker = !state_.flicker;
      return touch();
    case Action::kDeselect:
      state_.selection.reset();
      state_.inspection.reset();
      return;
    case Action::kQuit:
      quit_ = true;
      return;
    case Action::kScreenshot:
      return screenshot(/*withInterface=*/false);
    case Action::kScreenshotInterface:
      screenshotSoon_ = true;
      return;
    default:
      break;
  }
  if (document == nullptr) return;
  switch (action) {
    case Action::kReset:
      state_.playing = false;
      for (std::size_t i = 0; i < documents_.size(); ++i) {
        if (!follows(i, state_.current)) continue;
        documents_[i]->camera = starts_[i];
        documents_[i]->loadPath();
      }
      return touch();
    case Action::kClose:
      return closeCurrent();
    case Action::kFrame: {
      const scene::Camera camera = cameraOf(state_.current);
      const Region where = region(state_.current);
      const Aabb box = state_.inspection ? state_.inspection->boundsWorld : document->boundsWorld();
      return movePose(framed(currentPose(), box, camera.fovY, std::max(where.width, 1.0F) / where.height));
    }
    case Action::kFreeze:
      return freezeOrThaw();
    case Action::kPlay:
      if (!state_.playing && document->pathFrames() == 0)
        return say("the file has no camera path: record one, or name one");
      state_.playing = !state_.playing;
      pathSeconds_ = static_cast<double>(document->camera.frame.value_or(0.0F)) / static_cast<double>(scene::kPathRate);
      return touch();
    case Action::kRecord:
      if (state_.recording) return stopRecording();
      state_.recording = true;
      recordsFrom_ = document;
      recordStart_ = now();
      recorded_ = {};
      return say("recording: Ctrl+R stops");
    case Action::kCopyCommand:
      glfwSetClipboardString(window_.handle(), command(0, "frame.png", /*absolute=*/true).c_str());
      return say("copied: " + command(0, "frame.png", /*absolute=*/true));
    default:
      return;
  }
}

}  // namespace jalousie::app
