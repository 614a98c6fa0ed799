// Chooses the reader by the first bytes, and collects the rows.
#include "asset/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

#include "asset/image/codecs.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::asset {
namespace {

/// Bytes of the largest picture file read; far above what any allowed size compresses to.
constexpr std::uint64_t kMaxImageFileBytes = 1ULL << 30U;

using Read = ImageSize (*)(std::span<const std::byte> encoded, const ImageLimits& limits, detail::RowSink* sink);

struct Format {
  std::string_view mimeType;
  bool (*matches)(std::string_view bytes);
  Read read;
  bool comesInRows;
};

constexpr std::array kFormats = {
    Format{"image/png", [](std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1A\n"); }, detail::readPng,
           true},
    Format{"image/jpeg", [](std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }, detail::readJpeg,
           true},
    Format{"image/webp",
           [](std::string_view bytes) {
             return bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP";
           },
           detail::readWebp, false}};

/// Formats that are not read, for the message.
std::string_view foreignName(std::string_view bytes) {
  using Name = std::pair<std::string_view, std::string_view>;
  for (const auto& [start, name] :
       {Name{"GIF8", "GIF"}, Name{"BM", "BMP"}, Name{"8BPS", "PSD"}, Name{"#?RADIANCE", "Radiance HDR"},
        Name{"\xABKTX 20", "KTX2"}, Name{"\xABKTX 11", "KTX"}, Name{"DDS ", "DDS"}, Name{"II*", "TIFF"},
        Name{"MM", "TIFF"}})
    if (bytes.starts_with(start)) return name;
  return bytes.size() >= 12 && bytes.substr(4, 8) == "ftypavif" ? "AVIF" : "";
}

const Format* findFormat(std::span<const std::byte> encoded) {
  const std::string_view bytes(reinterpret_cast<const char*>(encoded.data()), encoded.size());
  const auto* found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& format) { return format.matches(bytes); });
  return found == kFormats.end() ? nullptr : found;
}

const Format& requireFormat(std::span<const std::byte> encoded) {
  if (encoded.empty()) throw Error(ErrorCode::kMalformed, "the picture is empty");
  if (const Format* format = findFormat(encoded)) return *format;
  const std::string_view name = foreignName({reinterpret_cast<const char*>(encoded.data()), encoded.size()});
  throw Error(ErrorCode::kUnsupported,
              name.empty() ? std::string("the picture is neither PNG, JPEG nor WebP")
                           : fmt::format("the format of the picture is {}; PNG, JPEG and WebP are read", name));
}

/// Keeps all rows. Memory is reserved at once and filled row by row, so that a file which ends early costs only what it
/// brought.
class WholePicture : public detail::RowSink {
 public:
  void begin(const ImageSize& size) override {
    image_.width = size.width;
    image_.height = size.height;
    image_.pixels.reserve(image_.offset(0, size.height));
  }
  std::uint8_t* row(std::uint32_t y) override {
    if (image_.pixels.size() < image_.offset(0, y + 1)) image_.pixels.resize(image_.offset(0, y + 1));
    return image_.pixels.data() + image_.offset(0, y);
  }
  ImageRgba8 take() { return std::move(image_); }

 private:
  ImageRgba8 image_;
};

/// Keeps nothing.
class OneRow : public detail::RowSink {
 public:
  void begin(const ImageSize& size) override { row_.resize(std::size_t{4} * size.width); }
  std::uint8_t* row(std::uint32_t) override { return row_.data(); }

 private:
  std::vector<std::uint8_t> row_;
};

/// Runs a reader; its errors get the name of the picture. @param sink  null: the header only
ImageSize readPicture(std::span<const std::byte> encoded, const ImageLimits& limits, detail::RowSink* sink,
                      const std::filesystem::path& source) {
  try {
    return requireFormat(encoded).read(encoded, limits, sink);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), source);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::kLimit, "out of memory for a picture", source);
  }
}

}  // namespace

namespace detail {

void requireSize(const ImageSize& size, const ImageLimits& limits) {
  if (size.width == 0 || size.height == 0) throw Error(ErrorCode::kMalformed, "the picture has no pixels");
  if (size.width > limits.maxSide || size.height > limits.maxSide)
    throw Error(ErrorCode::kLimit,
                fmt::format("the picture has {} x {} pixels, the limit is {} a side; no option lifts it", size.width,
                            size.height, limits.maxSide));
  if (std::uint64_t{size.width} * size.height > limits.maxPixels)
    throw Error(ErrorCode::kLimit,
                fmt::format("the picture has {} x {} pixels, the limit is {} in all; no option lifts it", size.width,
                            size.height, limits.maxPixels));
}

void requireBytes(std::uint64_t bytes, std::uint64_t leastBytes, const ImageSize& size) {
  if (bytes < leastBytes)
    throw Error(ErrorCode::kMalformed, fmt::format("the picture is cut off: {} bytes cannot hold {} x {} pixels", bytes,
                                                   size.width, size.height));
}

}  // namespace detail

std::string_view imageMimeType(std::span<const std::byte> encoded) {
  const Format* format = findFormat(encoded);
  return format == nullptr ? std::string_view() : format->mimeType;
}

ImageSize imageSize(std::span<const std::byte> encoded, const ImageLimits& limits,
                    const std::filesystem::path& source) {
  return readPicture(encoded, limits, nullptr, source);
}

ImageRgba8 decodeImage(std::span<const std::byte> encoded, const ImageLimits& limits,
                       const std::filesystem::path& source) {
  WholePicture picture;
  readPicture(encoded, limits, &picture, source);
  return picture.take();
}

void checkImage(std::span<const std::byte> encoded, const ImageLimits& limits, const std::filesystem::path& source) {
  const Format* format = findFormat(encoded);
  WholePicture picture;
  OneRow row;
  const bool inRows = format == nullptr || format->comesInRows;
  readPicture(encoded, limits, inRows ? static_cast<detail::RowSink*>(&row) : &picture, source);
}

void savePng(const ImageRgba8& image, const std::filesystem::path& path) {
  writeFileAtomic(path, encodePng(image));
}

ImageSize imageFileSize(const std::filesystem::path& path, const ImageLimits& limits) {
  return imageSize(readFile(path, kMaxImageFileBytes), limits, path);
}

ImageRgba8 loadImage(const std::filesystem::path& path, const ImageLimits& limits) {
  return decodeImage(readFile(path, kMaxImageFileBytes), limits, path);
}

}  // namespace jalousie::asset
