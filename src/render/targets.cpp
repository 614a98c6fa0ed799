// Creation and clearing of the frame's targets.
#include "render/targets.h"

#include <array>

namespace jalousie::render {
namespace {

constexpr std::array<float, 4> kBackground = {0.235F, 0.29F, 0.36F, 1.0F};  // linear RGB
constexpr std::array<GLuint, 4> kNoObject = {};
constexpr float kFarDepth = 0.0F;  // reversed depth

}  // namespace

Targets::Targets(std::uint32_t widthPixels, std::uint32_t heightPixels)
    : width(widthPixels),
      height(heightPixels),
      color(GL_TEXTURE_2D, GL_SRGB8_ALPHA8, {width, height, 1, 1}, "frame colour"),
      depth(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {width, height, 1, 1}, "frame depth"),
      id(GL_TEXTURE_2D, GL_R32UI, {width, height, 1, 1}, "object numbers"),
      frame(color, &depth, "frame"),
      view(color, nullptr, "view"),
      ids(id, &depth, "object numbers"),
      counted(color, &depth, "frame and item buffer", &id) {
  id.setSampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);  // integers are not filtered
}

void Targets::begin(const gl::Framebuffer& target) const {
  bind(target);
  const bool holdsColor = target.id() != ids.id();
  if (holdsColor) glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, kBackground.data());
  if (target.id() == counted.id()) glClearNamedFramebufferuiv(target.id(), GL_COLOR, 1, kNoObject.data());
  if (!holdsColor) glClearNamedFramebufferuiv(target.id(), GL_COLOR, 0, kNoObject.data());
  glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &kFarDepth);
}

}  // namespace jalousie::render
