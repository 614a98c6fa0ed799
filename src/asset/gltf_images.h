// The pictures of a document: which one a texture shows, and whether all of them can be decoded.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "asset/read_limits.h"
#include "core/error.h"

namespace jalousie::asset {

/// Decodes every PNG, JPEG and WebP of a document and keeps none, so that no broken one is passed on; equal ones are
/// decoded once. Each takes the memory of checkImage. @param path the document's file, for messages Errors: as
/// decodeImage; kFileNotFound for a picture whose file is missing; kLimit if the pictures have far more pixels than
/// bytes. The message names the picture.
void checkImages(const tinygltf::Model& model, const std::filesystem::path& path, const Limits& limits = {});

namespace detail {

/// The MIME type of a picture that extensions allow and nobody here decodes: KTX2, AVIF, DDS; else empty. Such pictures
/// are passed on as they are.
std::string_view foreignMimeType(std::span<const std::byte> encoded);

/// Index of the picture that a texture shows: that of EXT_texture_webp if present; -1: none. Errors (without a file):
/// kMalformed for an extension without an index.
int imageOfTexture(const tinygltf::Texture& texture);

/// Throws `error`, whose message then begins with "image 3: " or "image 3 (wood.png): ".
[[noreturn]] void rethrowForImage(const tinygltf::Model& model, std::size_t image, const Error& error);

/// What `use` makes of the encoded bytes of a picture; its errors name the picture.
template <class Use>
auto useImage(const tinygltf::Model& model, std::size_t image, const Use& use) {
  try {
    return use(std::as_bytes(std::span(model.images[image].image)));
  } catch (const Error& error) {
    rethrowForImage(model, image, error);
  }
}

}  // namespace detail
}  // namespace jalousie::asset
