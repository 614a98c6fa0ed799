// Equal pictures are found by their bytes; the pixels of all others are bounded by the bytes that they come from.
#include "asset/gltf_images.h"

#include <fmt/format.h>

#include <set>
#include <string_view>

#include "asset/image_io.h"

namespace jalousie::asset {
namespace {

constexpr const char* kWebp = "EXT_texture_webp";

/// A WebP of a few bytes can have any number of pixels of one colour, and decoding takes time for each pixel.
constexpr std::uint64_t kMaxPixelsPerByte = 1024;

class ImageCheck {
 public:
  ImageCheck(const tinygltf::Model& model, const Limits& limits) : model_(model), limits_(limits) {}

  void run() {
    std::set<std::size_t> drawn;  // by every reader, also those that know no extension
    for (const tinygltf::Texture& texture : model_.textures)
      if (texture.source >= 0) drawn.insert(static_cast<std::size_t>(texture.source));
    for (std::size_t i = 0; i < model_.images.size(); ++i)
      detail::useImage(model_, i, [&](std::span<const std::byte> bytes) {
        if (bytes.empty()) throw Error(ErrorCode::kFileNotFound, "no such file");
        check(bytes, drawn.contains(i));
      });
  }

 private:
  void check(std::span<const std::byte> bytes, bool isDrawn) {
    if (!isDrawn && !detail::foreignMimeType(bytes).empty()) return;
    if (!seen_.insert({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).second) return;
    const ImageSize size = imageSize(bytes, limits_.images);
    bytes_ += bytes.size();
    pixels_ += std::uint64_t{size.width} * size.height;
    if (pixels_ > limits_.maxFreePixels + kMaxPixelsPerByte * bytes_)
      throw Error(ErrorCode::kLimit, fmt::format("with it the pictures have {} pixels out of {} bytes; the limit is {} "
                                                 "and {} for each byte",
                                                 pixels_, bytes_, limits_.maxFreePixels, kMaxPixelsPerByte));
    checkImage(bytes, limits_.images);
  }

  const tinygltf::Model& model_;
  const Limits& limits_;
  std::set<std::string_view> seen_;
  std::uint64_t bytes_ = 0;
  std::uint64_t pixels_ = 0;
};

std::string nameOf(const tinygltf::Image& image, std::size_t index) {
  return image.uri.empty() ? fmt::format("image {}", index) : fmt::format("image {} ({})", index, image.uri);
}

}  // namespace

void checkImages(const tinygltf::Model& model, const std::filesystem::path& path, const Limits& limits) {
  try {
    ImageCheck(model, limits).run();
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), path);
  }
}

namespace detail {

std::string_view foreignMimeType(std::span<const std::byte> encoded) {
  const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
  if (text.starts_with("\xABKTX 20\xBB")) return "image/ktx2";
  if (text.starts_with("DDS ")) return "image/vnd-ms.dds";
  if (text.size() >= 12 && text.substr(4, 8) == "ftypavif") return "image/avif";
  return {};
}

int imageOfTexture(const tinygltf::Texture& texture) {
  const auto found = texture.extensions.find(kWebp);
  if (found == texture.extensions.end()) return texture.source;
  const tinygltf::Value& source = found->second.Get("source");
  if (!source.IsInt()) throw Error(ErrorCode::kMalformed, fmt::format("{} without a source", kWebp));
  return source.GetNumberAsInt();
}

void rethrowForImage(const tinygltf::Model& model, std::size_t image, const Error& error) {
  throw Error(error.code(), fmt::format("{}: {}", nameOf(model.images[image], image), error.what()));
}

}  // namespace detail
}  // namespace jalousie::asset
