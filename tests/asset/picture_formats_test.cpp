// Every kind of PNG, JPEG and WebP gives the right pixels; every broken one its code and its reason.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <random>

#include "asset/image_io.h"
#include "core/error.h"
#include "support/broken_pictures.h"
#include "support/picture_writer.h"

namespace jalousie::asset {
namespace {

using namespace jalousie::test;
using Pixel = std::array<std::uint8_t, 4>;

std::span<const std::byte> asBytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

Pixel pixelOf(const ImageRgba8& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* pixel = image.pixels.data() + image.offset(x, y);
  return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

Pixel paletteColour(std::uint32_t index) {
  const auto value = [](std::uint32_t i) { return static_cast<std::uint8_t>(37 * i); };
  return {value(3 * index), value(3 * index + 1), value(3 * index + 2), 255};
}

std::string paletteChunk(unsigned depth) {
  std::string data;
  for (std::uint32_t i = 0; i < 1U << depth; ++i) {
    const Pixel colour = paletteColour(i);
    data.append(reinterpret_cast<const char*>(colour.data()), 3);
  }
  return pngChunk("PLTE", data);
}

/// The pixel that a PNG of pngSample holds, without transparency by colour.
Pixel expectedPixel(const PngSpec& spec, std::uint32_t x, std::uint32_t y) {
  if (spec.colourType == 3) return paletteColour(pngSample(spec, x, y, 0));
  const auto value = [&](unsigned channel) {
    const std::uint32_t sample = pngSample(spec, x, y, channel);
    return static_cast<std::uint8_t>(spec.depth == 16 ? sample >> 8U : sample * 255 / ((1U << spec.depth) - 1));
  };
  switch (spec.colourType) {
    case 0:
      return {value(0), value(0), value(0), 255};
    case 2:
      return {value(0), value(1), value(2), 255};
    case 4:
      return {value(0), value(0), value(0), value(1)};
    default:
      return {value(0), value(1), value(2), value(3)};
  }
}

void expectPng(const PngSpec& spec) {
  SCOPED_TRACE(testing::Message() << "type " << spec.colourType << ", " << spec.depth << " bits, interlaced "
                                  << spec.interlaced << ", " << spec.width << " x " << spec.height);
  const ImageRgba8 image = decodeImage(asBytes(pngFile(spec)));
  ASSERT_EQ(image.width, spec.width);
  ASSERT_EQ(image.height, spec.height);
  for (std::uint32_t y = 0; y < spec.height; ++y)
    for (std::uint32_t x = 0; x < spec.width; ++x)
      ASSERT_EQ(pixelOf(image, x, y), expectedPixel(spec, x, y)) << x << ", " << y;
}

TEST(PictureFormats, PngOfEveryTypeAndDepth) {
  const std::array<std::vector<unsigned>, 7> depths = {
      {{1, 2, 4, 8, 16}, {}, {8, 16}, {1, 2, 4, 8}, {8, 16}, {}, {8, 16}}};
  for (unsigned type = 0; type < depths.size(); ++type) {
    for (const unsigned depth : depths[type]) {
      for (const bool interlaced : {false, true}) {
        for (const std::uint32_t width : {1U, 3U, 13U}) {
          PngSpec spec{.width = width, .height = 11, .depth = depth, .colourType = type, .interlaced = interlaced};
          if (type == 3) spec.before = paletteChunk(depth);
          expectPng(spec);
        }
      }
    }
  }
}

TEST(PictureFormats, PngTransparencyByColour) {
  PngSpec grey{.depth = 2, .colourType = 0, .before = pngChunk("tRNS", std::string("\0\2", 2))};
  PngSpec deep{.depth = 16, .colourType = 2};
  std::string colour;
  for (unsigned c = 0; c < 3; ++c) {
    const std::uint32_t sample = pngSample(deep, 5, 6, c);
    colour += static_cast<char>(sample >> 8U);
    colour += static_cast<char>(sample & 255U);
  }
  deep.before = pngChunk("tRNS", colour);
  const ImageRgba8 greyImage = decodeImage(asBytes(pngFile(grey)));
  const ImageRgba8 deepImage = decodeImage(asBytes(pngFile(deep)));
  for (std::uint32_t y = 0; y < grey.height; ++y) {
    for (std::uint32_t x = 0; x < grey.width; ++x) {
      EXPECT_EQ(pixelOf(greyImage, x, y)[3], pngSample(grey, x, y, 0) == 2 ? 0 : 255);
      EXPECT_EQ(pixelOf(deepImage, x, y)[3], x == 5 && y == 6 ? 0 : 255);  // all 16 bits decide
    }
  }
}

TEST(PictureFormats, PngTransparencyOfAPalette) {
  const PngSpec spec{
      .depth = 4, .colourType = 3, .before = paletteChunk(4) + pngChunk("tRNS", std::string("\5\6\7", 3))};
  const ImageRgba8 image = decodeImage(asBytes(pngFile(spec)));
  for (std::uint32_t x = 0; x < spec.width; ++x) {
    const std::uint32_t index = pngSample(spec, x, 3, 0);
    EXPECT_EQ(pixelOf(image, x, 3)[3], index < 3 ? index + 5 : 255);
  }
}

/// Largest difference of any channel from what was encoded.
int jpegDifference(const JpegSpec& spec, const std::function<Pixel(std::uint32_t, std::uint32_t)>& expected) {
  const ImageRgba8 image = decodeImage(asBytes(jpegFile(spec)));
  EXPECT_EQ(image.width, spec.width);
  EXPECT_EQ(image.height, spec.height);
  int largest = 0;
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(pixelOf(image, x, y)[c] - expected(x, y)[c]));
  return largest;
}

constexpr int kJpegError = 8;  // quality 95, colour at half the resolution

TEST(PictureFormats, JpegOfOneAndThreeChannels) {
  for (const bool progressive : {false, true}) {
    const auto grey = [](std::uint32_t x, std::uint32_t y) {
      const std::uint8_t value = jpegSample(x, y, 0);
      return Pixel{value, value, value, 255};
    };
    const auto rgb = [](std::uint32_t x, std::uint32_t y) {
      return Pixel{jpegSample(x, y, 0), jpegSample(x, y, 1), jpegSample(x, y, 2), 255};
    };
    EXPECT_LE(jpegDifference({.colours = JpegColours::kGrey, .progressive = progressive}, grey), kJpegError);
    EXPECT_LE(jpegDifference({.colours = JpegColours::kYcc, .progressive = progressive}, rgb), kJpegError);
    EXPECT_LE(jpegDifference({.colours = JpegColours::kRgb, .progressive = progressive}, rgb), kJpegError);
  }
}

TEST(PictureFormats, JpegOfFourChannels) {
  const auto light = [](std::uint32_t x, std::uint32_t y, bool inverted) {
    Pixel pixel{0, 0, 0, 255};
    const auto of = [&](unsigned c) { return inverted ? jpegSample(x, y, c) : 255 - jpegSample(x, y, c); };
    for (unsigned c = 0; c < 3; ++c)
      pixel[c] = static_cast<std::uint8_t>((of(c) * of(3) + 127) / 255);
    return pixel;
  };
  const auto adobe = [&](std::uint32_t x, std::uint32_t y) { return light(x, y, true); };
  const auto plain = [&](std::uint32_t x, std::uint32_t y) { return light(x, y, false); };
  EXPECT_LE(jpegDifference({.colours = JpegColours::kCmyk}, adobe), kJpegError);
  EXPECT_LE(jpegDifference({.colours = JpegColours::kYcck}, adobe), kJpegError);
  EXPECT_LE(jpegDifference({.colours = JpegColours::kCmyk, .adobe = false}, plain), kJpegError);
}

TEST(PictureFormats, WebpOfBothKinds) {
  const ImageRgba8 image = noisePicture(21, 9);
  const ImageRgba8 read = decodeImage(asBytes(webpFile(image, true)));
  ASSERT_EQ(read.width, 21U);
  ASSERT_EQ(read.height, 9U);
  for (std::uint32_t x = 0; x < image.width; ++x) {
    const Pixel pixel = pixelOf(image, x, 4);
    if (pixel[3] == 0) continue;  // libwebp clears what cannot be seen
    EXPECT_EQ(pixelOf(read, x, 4), pixel);
  }
  ImageRgba8 flat{32, 16, {}};
  for (int i = 0; i < 32 * 16; ++i)
    flat.pixels.insert(flat.pixels.end(), {180, 120, 60, 255});
  const ImageRgba8 lossy = decodeImage(asBytes(webpFile(flat, false)));
  ASSERT_EQ(lossy.pixels.size(), flat.pixels.size());
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_NEAR(pixelOf(lossy, 20, 10)[c], flat.pixels[c], 4);
}

/// Code and message of a refusal; "accepted" if there is none.
std::pair<std::optional<ErrorCode>, std::string> refusalOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {std::nullopt, "accepted"};
}

void expectRefused(const std::vector<BrokenPicture>& pictures) {
  for (const BrokenPicture& picture : pictures) {
    SCOPED_TRACE(picture.name);
    const auto [code, message] = refusalOf([&] { decodeImage(asBytes(picture.bytes), {}, picture.name); });
    EXPECT_EQ(code, picture.code) << message;
    EXPECT_NE(message.find(picture.reason), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(picture.name + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(refusalOf([&] { checkImage(asBytes(picture.bytes), {}, picture.name); }), std::pair(code, message));
  }
}

TEST(PictureFormats, BrokenPicturesAreRefusedWithTheirReason) {
  const std::vector<BrokenPicture> pictures = brokenPictures();
  EXPECT_GE(pictures.size(), 35U);
  expectRefused(pictures);
}

TEST(PictureFormats, CutPicturesAreRefused) {
  const std::vector<BrokenPicture> pictures = cutPictures();
  EXPECT_GE(pictures.size(), 300U);
  expectRefused(pictures);
}

TEST(PictureFormats, OddPicturesAreRead) {
  for (const OddPicture& picture : oddPictures()) {
    const auto [code, message] = refusalOf([&] {
      const ImageRgba8 image = decodeImage(asBytes(picture.bytes));
      EXPECT_EQ(image.pixels.size(), image.offset(0, image.height));
    });
    EXPECT_EQ(message, "accepted") << picture.name;
  }
}

TEST(PictureFormats, SizeComesFromTheHeader) {
  for (const std::string& file :
       {pngFile({.width = 40, .height = 24}), jpegFile({}), webpFile(noisePicture(40, 24), true)}) {
    const ImageSize size = imageSize(asBytes(file));
    EXPECT_EQ(size.width, 40U);
    EXPECT_EQ(size.height, 24U);
    EXPECT_EQ(refusalOf([&] { imageSize(asBytes(file), {.maxSide = 39}); }).first, ErrorCode::kLimit);
    EXPECT_EQ(refusalOf([&] { imageSize(asBytes(file), {.maxPixels = 40 * 24 - 1}); }).first, ErrorCode::kLimit);
    EXPECT_EQ(imageSize(asBytes(file), {.maxSide = 40, .maxPixels = 40 * 24}).width, 40U);
  }
}

TEST(PictureFormats, FlippedBytesAreReadOrRefused) {
  const ImageLimits limits{.maxSide = 256};
  std::mt19937 random(7);
  std::size_t refused = 0;
  for (const std::string& file : {pngFile({.depth = 4, .colourType = 3, .interlaced = true, .before = paletteChunk(4)}),
                                  jpegFile({}), jpegFile({.colours = JpegColours::kYcck, .progressive = true}),
                                  webpFile(noisePicture(16, 16), true), webpFile(noisePicture(16, 16), false)}) {
    for (int i = 0; i < 2000; ++i) {
      std::string broken = file;
      for (int k = 0; k < 1 + i % 3; ++k)
        broken[random() % broken.size()] = static_cast<char>(random());
      const auto [code, message] = refusalOf([&] { decodeImage(asBytes(broken), limits); });
      refused += code ? 1U : 0U;
      EXPECT_TRUE(!code || code == ErrorCode::kMalformed || code == ErrorCode::kUnsupported ||
                  code == ErrorCode::kLimit)
          << message;
    }
  }
  EXPECT_GT(refused, 3000U);
}

TEST(PictureFormats, MimeTypeByTheFirstBytes) {
  EXPECT_EQ(imageMimeType(asBytes(pngFile({}))), "image/png");
  EXPECT_EQ(imageMimeType(asBytes(jpegFile({}))), "image/jpeg");
  EXPECT_EQ(imageMimeType(asBytes(webpFile(noisePicture(4, 4), true))), "image/webp");
  EXPECT_EQ(imageMimeType(asBytes("RIFF....WAVE")), "");
  EXPECT_EQ(imageMimeType({}), "");
}

}  // namespace
}  // namespace jalousie::asset
