// The picture of the window: a texture with a framebuffer.
#include "app/view/canvas.h"

#include <array>

namespace jalousie::app {
namespace {

constexpr std::array<float, 4> kEmpty = {0.13F, 0.14F, 0.16F, 1.0F};

}  // namespace

void Canvas::resize(std::uint32_t width, std::uint32_t height) {
  if (width == width_ && height == height_) return;
  framebuffer_.reset();
  texture_.emplace(GL_TEXTURE_2D, GL_RGBA8, gl::TextureSize{width, height, 1, 1}, "canvas");
  framebuffer_.emplace(*texture_, nullptr, "canvas");
  width_ = width;
  height_ = height;
}

void Canvas::clear() const {
  glClearNamedFramebufferfv(framebuffer_->id(), GL_COLOR, 0, kEmpty.data());
}

void Canvas::copy(const gl::Texture& source, std::uint32_t fromX, std::uint32_t toX, std::uint32_t columns) const {
  if (columns == 0) return;
  glCopyImageSubData(source.id(), GL_TEXTURE_2D, 0, static_cast<GLint>(fromX), 0, 0, texture_->id(), GL_TEXTURE_2D, 0,
                     static_cast<GLint>(toX), 0, 0, static_cast<GLsizei>(columns), static_cast<GLsizei>(height_), 1);
}

void Canvas::show() const {
  const auto w = static_cast<GLint>(width_);
  const auto h = static_cast<GLint>(height_);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);  // some drivers update the size of a window only when it is bound
  glViewport(0, 0, w, h);
  glBlitNamedFramebuffer(framebuffer_->id(), 0, 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace jalousie::app
