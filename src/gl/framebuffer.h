// Framebuffers over textures; there is no default framebuffer in a headless context.
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
  /// glCreateFramebuffers, glNamedFramebufferTexture (level 0). @param depth  may be null
  /// Errors: kNoGpu if the driver calls the combination incomplete.
  /// @param second  a second colour attachment, or null
  Framebuffer(const Texture& color, const Texture* depth, const char* name, const Texture* second = nullptr);

  GLuint id() const { return handle_.id(); }
  /// glBindFramebuffer and glViewport.
  void bind(std::uint32_t width, std::uint32_t height) const;
  /// glReadPixels of the colour attachment: waits for the GPU. Row 0 of the result is the top one.
  ImageRgba8 readRgba8(std::uint32_t width, std::uint32_t height) const;
  /// The same for a single-channel float attachment; row 0 is the bottom one, as in the texture.
  std::vector<float> readRed(std::uint32_t width, std::uint32_t height) const;
  /// The same for a single-channel unsigned integer attachment.
  std::vector<std::uint32_t> readRedInteger(std::uint32_t width, std::uint32_t height) const;
  /// The same for the depth attachment.
  std::vector<float> readDepth(std::uint32_t width, std::uint32_t height) const;

 private:
  Handle<FramebufferTraits> handle_;
};

}  // namespace jalousie::gl
