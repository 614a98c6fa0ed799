// Framebuffers that draw into textures. A headless context has no default framebuffer.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "gl/texture.h"

namespace jalousie::gl {

/// A framebuffer that draws into textures owned elsewhere, which must outlive it.
class Framebuffer {
 public:
  Framebuffer() = default;
  /// glCreateFramebuffers, glNamedFramebufferTexture (level 0).
  /// @param depth   depth attachment, or null
  /// @param second  second colour attachment, or null
  /// Errors: kNoGpu if the driver reports the combination as incomplete.
  Framebuffer(const Texture& color, const Texture* depth, const char* name, const Texture* second = nullptr);

  GLuint id() const { return handle_.id(); }
  /// glBindFramebuffer and glViewport.
  void bind(std::uint32_t width, std::uint32_t height) const;
  /// glReadPixels of the colour attachment: waits for the GPU. Row 0 of the result is the top one.
  ImageRgba8 readRgba8(std::uint32_t width, std::uint32_t height) const;
  /// Reads a single-channel float attachment: waits for the GPU. Row 0 of the result is the bottom one.
  std::vector<float> readRed(std::uint32_t width, std::uint32_t height) const;
  /// Reads a single-channel unsigned integer attachment, as readRed().
  std::vector<std::uint32_t> readRedInteger(std::uint32_t width, std::uint32_t height) const;
  /// Reads the depth attachment, as readRed().
  std::vector<float> readDepth(std::uint32_t width, std::uint32_t height) const;

 private:
  Handle<FramebufferTraits> handle_;
};

}  // namespace jalousie::gl
