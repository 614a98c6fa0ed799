// The picture of the window before it is shown: pictures of scenes side by side, then the interface.
#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace jalousie::app {

/// An off-screen picture, so that a screenshot does not depend on what covers the window.
class Canvas {
 public:
  /// Does nothing if the canvas has that size. @pre width, height > 0
  void resize(std::uint32_t width, std::uint32_t height);
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

  /// Fills the canvas with the colour of an empty window: glClearNamedFramebufferfv.
  void clear() const;
  /// Copies columns of a picture of the same height, bit for bit: glCopyImageSubData.
  /// @param source  GL_SRGB8_ALPHA8   @param fromX  first column of the source   @param toX  first column of the canvas
  void copy(const gl::Texture& source, std::uint32_t fromX, std::uint32_t toX, std::uint32_t columns) const;
  /// Makes the canvas the target of the interface: glBindFramebuffer, glViewport.
  void bind() const { framebuffer_->bind(width_, height_); }
  /// The canvas as an image. Waits for the GPU.
  ImageRgba8 read() const { return framebuffer_->readRgba8(width_, height_); }
  /// Copies the canvas to the window: glBlitNamedFramebuffer.
  void show() const;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::optional<gl::Texture> texture_;
  std::optional<gl::Framebuffer> framebuffer_;
};

}  // namespace jalousie::app
