// Creation and clearing of the frame's targets.
#include "render/targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "core/error.h"

namespace jalousie::render {
namespace {

constexpr std::array<float, 4> kBackground = {0.235F, 0.29F, 0.36F, 1.0F};  // linear RGB
constexpr std::array<GLuint, 4> kNoObject = {};
constexpr float kFarDepth = 0.0F;  // reversed depth

/// The width, after the driver was asked whether it has textures of the size of the occlusion map, whose sides are the
/// next powers of two. Errors: kLimit.
std::uint32_t allowedWidth(std::uint32_t width, std::uint32_t height) {
  GLint texture = 0;
  GLint viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  const auto most = static_cast<std::uint32_t>(std::min({texture, viewport[0], viewport[1]}));
  if (std::bit_ceil(std::max(width, height)) > most)
    throw Error(ErrorCode::kLimit, "pictures of " + std::to_string(width) + 'x' + std::to_string(height) +
                                       " pixels are larger than this driver allows: " +
                                       std::to_string(std::bit_floor(most)) + " pixels a side");
  return width;
}

}  // namespace

Targets::Targets(std::uint32_t widthPixels, std::uint32_t heightPixels)
    : width(allowedWidth(widthPixels, heightPixels)),
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
