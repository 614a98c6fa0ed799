// Textures with immutable storage.
#pragma once

#include <cstdint>
#include <span>

#include "gl/handle.h"

namespace jalousie::gl {

struct TextureSize {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint32_t layers = 1;  ///< 1 for GL_TEXTURE_2D
  std::uint32_t levels = 1;
};

/// A 2D texture or 2D array texture with fixed size and format.
class Texture {
 public:
  Texture() = default;
  /// glCreateTextures, glTextureStorage2D/3D. @param target  GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY
  Texture(GLenum target, GLenum internalFormat, const TextureSize& size, const char* name);

  GLuint id() const { return handle_.id(); }
  const TextureSize& size() const { return size_; }

  /// glTextureSubImage3D of RGBA8 rows.
  /// @pre the texture is an array; rgba has width * height * 4 bytes of the level (checked)
  void uploadLayer(std::uint32_t layer, std::uint32_t level, std::span<const std::uint8_t> rgba);
  /// glTextureSubImage2D of one byte per texel, rows from the bottom. @pre bytes match the level (checked)
  void uploadBytes(std::uint32_t level, std::span<const std::uint8_t> bytes);
  /// glTextureParameteri for filters and wrapping.
  void setSampling(GLint minFilter, GLint magFilter, GLint wrap);
  /// glClearTexImage of a single-channel float level.
  void clear(std::uint32_t level, float value);

  /// glBindTextureUnit.
  void bind(GLuint unit) const { glBindTextureUnit(unit, id()); }
  /// glBindImageTexture of one level. @param access  GL_READ_ONLY or GL_WRITE_ONLY
  void bindImage(GLuint unit, std::uint32_t level, GLenum access) const;

 private:
  Handle<TextureTraits> handle_;
  GLenum target_ = GL_TEXTURE_2D;
  GLenum internalFormat_ = GL_RGBA8;
  TextureSize size_;
};

}  // namespace jalousie::gl
