// PNG round trips, the formats that are refused, the size cap, resampling.
#include "asset/image_io.h"

#include "asset/asset_fixtures.h"

namespace jalousie::asset {
namespace {

using test::codeOf;

ImageRgba8 gradient(std::uint32_t width, std::uint32_t height, bool withAlpha) {
  ImageRgba8 image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 4)};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      std::uint8_t* pixel = image.pixels.data() + image.offset(x, y);
      pixel[0] = static_cast<std::uint8_t>(x * 7);
      pixel[1] = static_cast<std::uint8_t>(y * 5);
      pixel[2] = static_cast<std::uint8_t>(x ^ y);
      pixel[3] = withAlpha ? static_cast<std::uint8_t>(x + y) : 255;
    }
  }
  return image;
}

std::span<const std::byte> asBytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(ImageIo, PngRoundTripIsExact) {
  for (const bool withAlpha : {false, true}) {
    const ImageRgba8 image = gradient(37, 21, withAlpha);
    const ImageRgba8 read = decodeImage(encodePng(image), {64});
    EXPECT_EQ(read.width, 37U);
    EXPECT_EQ(read.height, 21U);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

TEST(ImageIo, EncodingTwiceGivesTheSameBytes) {
  EXPECT_EQ(encodePng(gradient(64, 64, true)), encodePng(gradient(64, 64, true)));
}

TEST(ImageIo, OpaqueImagesAreWrittenWithoutAlpha) {
  constexpr std::size_t kColourType = 25;  // in the IHDR chunk
  EXPECT_EQ(encodePng(gradient(8, 8, false))[kColourType], std::byte{2});
  EXPECT_EQ(encodePng(gradient(8, 8, true))[kColourType], std::byte{6});
}

TEST(ImageIo, SavedFileLoads) {
  const test::TempFolder folder;
  savePng(gradient(16, 9, true), folder / "image.png");
  EXPECT_EQ(loadImage(folder / "image.png").pixels, gradient(16, 9, true).pixels);
  EXPECT_EQ(codeOf([&] { loadImage(folder / "absent.png"); }), ErrorCode::kFileNotFound);
}

TEST(ImageIo, OtherFormatsNeverReachTheDecoder) {
  for (const std::string_view text : {"GIF89a\1\0\1\0\0\0\0;", "BM....", "#?RADIANCE\n", "P6 1 1 255 abc", "8BPS"})
    EXPECT_EQ(codeOf([&] { decodeImage(asBytes(text), {64}); }), ErrorCode::kUnsupported) << text;
  EXPECT_EQ(codeOf([&] { decodeImage({}, {64}); }), ErrorCode::kMalformed) << "empty";
}

TEST(ImageIo, TruncatedPngIsMalformed) {
  const std::vector<std::byte> png = encodePng(gradient(64, 64, true));
  for (const std::size_t size : {std::size_t{8}, std::size_t{20}, std::size_t{40}, png.size() / 2})
    EXPECT_EQ(codeOf([&] { decodeImage(std::span(png).first(size), {64}); }), ErrorCode::kMalformed) << size;
}

TEST(ImageIo, SideAboveTheLimitIsRefusedBeforeDecoding) {
  std::vector<std::byte> png = encodePng(gradient(64, 8, true));
  EXPECT_EQ(codeOf([&] { decodeImage(png, {63}); }), ErrorCode::kLimit);
  png.resize(60);  // the header alone decides
  EXPECT_EQ(codeOf([&] { decodeImage(png, {63}); }), ErrorCode::kLimit);
}

TEST(ImageIo, ResizeKeepsAConstantColour) {
  ImageRgba8 image{7, 5, {}};
  for (int i = 0; i < 35; ++i)
    image.pixels.insert(image.pixels.end(), {200, 100, 50, 255});
  const ImageRgba8 resized = resizeImage(image, 16, 32);
  ASSERT_EQ(resized.pixels.size(), 16U * 32U * 4U);
  for (std::size_t i = 0; i < resized.pixels.size(); i += 4) {
    EXPECT_NEAR(resized.pixels[i], 200, 1);
    EXPECT_NEAR(resized.pixels[i + 1], 100, 1);
    EXPECT_NEAR(resized.pixels[i + 2], 50, 1);
    EXPECT_EQ(resized.pixels[i + 3], 255);
  }
}

}  // namespace
}  // namespace jalousie::asset
