// The pyramid of open pixels.
#include "visibility/occlusion_map_reference.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "core/random.h"

namespace jalousie::visibility {
namespace {

std::vector<float> randomPixels(std::uint32_t width, std::uint32_t height, float openShare, std::uint64_t seed) {
  std::vector<float> pixels(std::size_t{width} * height);
  Random random(seed);
  for (float& pixel : pixels)
    pixel = random.uniform() < openShare ? 1.0F : 0.0F;
  return pixels;
}

TEST(OcclusionMap, EveryLevelCountsEveryOpenPixelOnceAtAnySize) {
  for (const auto& [width, height] :
       {std::array{64U, 64U}, {1366U, 77U}, {333U, 97U}, {1001U, 701U}, {1U, 1U}, {1U, 300U}, {257U, 2U}}) {
    const std::vector<float> pixels = randomPixels(width, height, 0.3F, width * height);
    const double open = std::accumulate(pixels.begin(), pixels.end(), 0.0);
    const OcclusionMapReference map(mapLayout(width, height), pixels);
    for (std::uint32_t level = 0; level < map.layout().levels; ++level) {
      const std::span<const float> texels = map.level(level);
      EXPECT_EQ(std::accumulate(texels.begin(), texels.end(), 0.0), open)
          << width << "x" << height << " level " << level;
    }
    EXPECT_EQ(map.level(map.layout().levels - 1).size(), 1U);
  }
}

TEST(OcclusionMap, AreasAddUpToTheScreen) {
  const MapLayout layout = mapLayout(1366, 768);
  const OcclusionMapReference map(layout, std::vector<float>(std::size_t{1366} * 768, 1.0F));
  for (std::uint32_t level = 0; level < layout.levels; ++level) {
    std::uint64_t area = 0;
    for (std::uint32_t y = 0; y < layout.levelHeight(level); ++y)
      for (std::uint32_t x = 0; x < layout.levelWidth(level); ++x)
        area += map.texelArea(x, y, level);
    EXPECT_EQ(area, 1366ULL * 768ULL);
  }
}

TEST(OcclusionMap, OnePixelHoleIsNeverRoundedAway) {
  const MapLayout layout = mapLayout(4096, 4096);
  std::vector<float> pixels(std::size_t{4096} * 4096, 0.0F);
  pixels[123456] = 1.0F;
  const OcclusionMapReference map(layout, pixels);
  EXPECT_LT(map.opacity(0, 0, layout.levels - 1), 1.0F);
  pixels[123456] = 0.0F;
  EXPECT_EQ(OcclusionMapReference(layout, pixels).opacity(0, 0, layout.levels - 1), 1.0F);
}

TEST(OcclusionMap, OnePixelSlitAtAnOddWidthSurvives) {
  std::vector<float> pixels(std::size_t{1366} * 16, 0.0F);
  for (std::uint32_t y = 0; y < 16; ++y)
    pixels[std::size_t{y} * 1366 + 1365] = 1.0F;
  const OcclusionMapReference map(mapLayout(1366, 16), pixels);
  for (std::uint32_t level = 0; level < map.layout().levels; ++level)
    EXPECT_LT(map.opacity(1365U >> level, 0, level), 1.0F) << "level " << level;
}

}  // namespace
}  // namespace jalousie::visibility
