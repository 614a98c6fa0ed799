// The textures and framebuffers of one frame.
#pragma once

#include <cstdint>

#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace jalousie::render {

/// Everything that depends on the size of the screen alone.
struct Targets {
  /// Errors: kLimit if the driver has no textures or viewports of this size, or no memory for them.
  Targets(std::uint32_t width, std::uint32_t height);

  /// Binds a framebuffer and clears what it holds: background colour, farthest depth, no object.
  void begin(const gl::Framebuffer& target) const;
  /// Binds a framebuffer and keeps what it holds.
  void bind(const gl::Framebuffer& target) const { target.bind(width, height); }

  std::uint32_t width;  ///< pixels
  std::uint32_t height;
  gl::Texture color;  ///< GL_SRGB8_ALPHA8
  gl::Texture depth;  ///< GL_DEPTH_COMPONENT32F, reversed
  gl::Texture id;     ///< GL_R32UI, object index + 1
  gl::Framebuffer frame;
  gl::Framebuffer view;  ///< the colour alone: the depth view reads the depth while it draws
  gl::Framebuffer ids;
  gl::Framebuffer counted;  ///< the frame, and its object numbers beside it
};

}  // namespace jalousie::render
