// Framebuffer creation and read-back.
#include "gl/framebuffer.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace jalousie::gl {

Framebuffer::Framebuffer(const Texture& color, const Texture* depth, const char* name, const Texture* second) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  handle_ = Handle<FramebufferTraits>(id);
  label(GL_FRAMEBUFFER, id, name);
  glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, color.id(), 0);
  if (depth != nullptr) glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth->id(), 0);
  if (second != nullptr) {
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT1, second->id(), 0);
    constexpr GLenum kBuffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(id, 2, kBuffers);
  }
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ErrorCode::kNoGpu, fmt::format("framebuffer '{}' is incomplete (0x{:04x})", name, status));
}

void Framebuffer::bind(std::uint32_t width, std::uint32_t height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
}

ImageRgba8 Framebuffer::readRgba8(std::uint32_t width, std::uint32_t height) const {
  ImageRgba8 image{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA, GL_UNSIGNED_BYTE,
               image.pixels.data());
  const std::size_t row = std::size_t{4} * width;
  for (std::uint32_t y = 0; y < height / 2; ++y)
    std::swap_ranges(image.pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * row));
  return image;
}

namespace {

template <class T>
std::vector<T> readPixels(GLuint framebuffer, std::uint32_t width, std::uint32_t height, GLenum format, GLenum type) {
  std::vector<T> values(std::size_t{width} * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), format, type, values.data());
  return values;
}

}  // namespace

std::vector<float> Framebuffer::readRed(std::uint32_t width, std::uint32_t height) const {
  return readPixels<float>(id(), width, height, GL_RED, GL_FLOAT);
}

std::vector<std::uint32_t> Framebuffer::readRedInteger(std::uint32_t width, std::uint32_t height) const {
  return readPixels<std::uint32_t>(id(), width, height, GL_RED_INTEGER, GL_UNSIGNED_INT);
}

std::vector<float> Framebuffer::readDepth(std::uint32_t width, std::uint32_t height) const {
  return readPixels<float>(id(), width, height, GL_DEPTH_COMPONENT, GL_FLOAT);
}

}  // namespace jalousie::gl
