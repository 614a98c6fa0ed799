// How pointer and keys move the camera and the divider.
#include "app/view/navigation.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jalousie::app {
namespace {

constexpr float kRadiansPerPixel = 0.005F;
constexpr float kClickPixels = 4.0F;
constexpr float kDividerPixels = 7.0F;
constexpr float kSpeedPerStep = 1.25F;
/// Share of the scene's diagonal that the camera flies in a second at speed 1.
constexpr float kFlightShare = 0.1F;
constexpr int kFlightKeys[] = {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E};

}  // namespace

Navigation::Navigation(ViewState& state, Documents& documents, Cameras& cameras, Messages& messages,
                       const Interface& interface)
    : state_(state), documents_(documents), cameras_(cameras), messages_(messages), interface_(interface) {}

void Navigation::press(const InputEvent& event) {
  pointer_ = event.at;
  state_.current = documents_.at(event.at).value_or(state_.current);
  dragFrom_ = event.at;
  dragged_ = false;
  drag_ = dragFor(event);
}

Navigation::Drag Navigation::dragFor(const InputEvent& event) const {
  if (event.code == GLFW_MOUSE_BUTTON_RIGHT) return Drag::kLook;
  if (event.code == GLFW_MOUSE_BUTTON_MIDDLE) return Drag::kPan;
  if (event.code != GLFW_MOUSE_BUTTON_LEFT) return drag_;
  const Region where = documents_.region(state_.current);
  const float toDivider = std::abs(event.at.x - where.x - state_.divider * where.width);
  if (state_.showsDivider() && toDivider < kDividerPixels * interface_.scale()) return Drag::kDivider;
  return (event.mods & GLFW_MOD_SHIFT) != 0 ? Drag::kPan : Drag::kTurn;
}

std::optional<glm::vec2> Navigation::release(const InputEvent& event) {
  pointer_ = event.at;
  const bool click = drag_ == Drag::kTurn && !dragged_ && event.code == GLFW_MOUSE_BUTTON_LEFT;
  endDrag();
  return click ? std::optional(event.at) : std::nullopt;
}

void Navigation::moveTo(const glm::vec2& pointer) {
  const glm::vec2 by = pointer - pointer_;
  pointer_ = pointer;
  if (drag_ == Drag::kNone || by == glm::vec2(0.0F)) return;
  if (drag_ == Drag::kDivider) {
    const Region where = documents_.region(state_.current);
    state_.divider = std::clamp((pointer.x - where.x) / std::max(where.width, 1.0F), 0.0F, 1.0F);
    return;
  }
  if (!dragged_ && glm::length(pointer - dragFrom_) < kClickPixels * interface_.scale()) return;
  const glm::vec2 pixels = dragged_ ? by : pointer - dragFrom_;
  dragged_ = true;
  if (documents_.current() != nullptr) dragCamera(pixels);
}

void Navigation::dragCamera(const glm::vec2& pixels) {
  const Pose pose = cameras_.pose();
  const glm::vec2 angles = kRadiansPerPixel * pixels;
  if (drag_ == Drag::kTurn) return cameras_.move(orbited(pose, -angles.x, angles.y));
  if (drag_ == Drag::kLook) return cameras_.move(turned(pose, -angles.x, -angles.y));
  scene::Camera camera = documents_.drawCamera(state_.current);
  camera.halfSize.reset();  // a pose is that of a perspective camera
  const glm::uvec2 viewport(documents_.region(state_.current).width, documents_.height());
  cameras_.move(panned(pose, pixels.x, -pixels.y, scene::focalPixels(camera, viewport)));
}

void Navigation::wheel(float steps, const Input& input) {
  if (documents_.current() == nullptr) return;
  const bool flying = drag_ == Drag::kLook || std::any_of(std::begin(kFlightKeys), std::end(kFlightKeys),
                                                          [&](int key) { return input.held(key); });
  if (!flying) return cameras_.move(zoomed(cameras_.pose(), steps));
  float& speed = state_.settings.speed;
  speed = std::clamp(speed * std::pow(kSpeedPerStep, steps), kLeastSpeed, kMostSpeed);
  messages_.say(fmt::format("Flying speed: {:.2f}", speed));
}

void Navigation::fly(double seconds, const Input& input) {
  if (documents_.current() == nullptr) return;
  if (input.held(GLFW_KEY_LEFT_CONTROL) || input.held(GLFW_KEY_RIGHT_CONTROL)) return;
  const auto axis = [&](int more, int less) {
    return static_cast<float>(input.held(more)) - static_cast<float>(input.held(less));
  };
  const glm::vec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S));
  if (direction == glm::vec3(0.0F)) return;
  const float diagonal = std::max(documents_.current()->boundsWorld().diagonal(), 1e-3F);
  const float distance = static_cast<float>(seconds) * kFlightShare * diagonal * state_.settings.speed;
  cameras_.move(moved(cameras_.pose(), distance * direction));
}

}  // namespace jalousie::app
