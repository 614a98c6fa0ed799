// Texture storage and transfers through direct state access.
#include "gl/texture.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/check.h"
#include "gl/memory.h"

namespace jalousie::gl {

Texture::Texture(GLenum target, GLenum internalFormat, const TextureSize& size, const char* name)
    : target_(target), internalFormat_(internalFormat), size_(size) {
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  handle_ = Handle<TextureTraits>(id);
  label(GL_TEXTURE, id, name);
  const auto levels = static_cast<GLsizei>(size.levels);
  const auto width = static_cast<GLsizei>(size.width);
  const auto height = static_cast<GLsizei>(size.height);
  if (target == GL_TEXTURE_2D) {
    glTextureStorage2D(id, levels, internalFormat, width, height);
  } else {
    glTextureStorage3D(id, levels, internalFormat, width, height, static_cast<GLsizei>(size.layers));
  }
  requireMemory(fmt::format("texture '{}' of {}x{}x{} texels", name, size.width, size.height, size.layers));
}

void Texture::uploadLayer(std::uint32_t layer, std::uint32_t level, std::span<const std::uint8_t> rgba) {
  JAL_CHECK(layer < size_.layers);
  JAL_CHECK(level < size_.levels);
  const std::uint32_t width = std::max(size_.width >> level, 1U);
  const std::uint32_t height = std::max(size_.height >> level, 1U);
  JAL_CHECK(rgba.size() == static_cast<std::size_t>(width) * height * 4);
  glTextureSubImage3D(id(), static_cast<GLint>(level), 0, 0, static_cast<GLint>(layer), static_cast<GLsizei>(width),
                      static_cast<GLsizei>(height), 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void Texture::uploadBytes(std::uint32_t level, std::span<const std::uint8_t> bytes) {
  JAL_CHECK(level < size_.levels);
  const std::uint32_t width = std::max(size_.width >> level, 1U);
  const std::uint32_t height = std::max(size_.height >> level, 1U);
  JAL_CHECK(bytes.size() == static_cast<std::size_t>(width) * height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(id(), static_cast<GLint>(level), 0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height),
                      GL_RED, GL_UNSIGNED_BYTE, bytes.data());
}

void Texture::setSampling(GLint minFilter, GLint magFilter, GLint wrap) {
  glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, minFilter);
  glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, magFilter);
  glTextureParameteri(id(), GL_TEXTURE_WRAP_S, wrap);
  glTextureParameteri(id(), GL_TEXTURE_WRAP_T, wrap);
}

void Texture::clear(std::uint32_t level, float value) {
  glClearTexImage(id(), static_cast<GLint>(level), GL_RED, GL_FLOAT, &value);
}

void Texture::bindImage(GLuint unit, std::uint32_t level, GLenum access) const {
  glBindImageTexture(unit, id(), static_cast<GLint>(level), GL_FALSE, 0, access, internalFormat_);
}

}  // namespace jalousie::gl
