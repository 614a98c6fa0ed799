// The kernels that build the occlusion map and the depth pyramid, bit for bit against their twins.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/gl_test.h"
#include "visibility/kernel_input.h"

namespace jalousie::visibility {
namespace {

class OcclusionMapGl : public test::GlTest {};

TEST_F(OcclusionMapGl, ReductionEqualsTheTwinBitForBitAtAnySize) {
  for (const ScreenSize size : kSizes) {
    const GivenMap map(size, structuredPixels(size, size.width));
    for (std::uint32_t level = 0; level < map.pass.layout().levels; ++level) {
      const std::span<const float> expected = map.reference.level(level);
      std::vector<float> actual(expected.size());
      glGetTextureImage(map.pass.texture().id(), static_cast<GLint>(level), GL_RED, GL_FLOAT,
                        static_cast<GLsizei>(actual.size() * sizeof(float)), actual.data());
      EXPECT_TRUE(std::equal(actual.begin(), actual.end(), expected.begin()))
          << size.width << "x" << size.height << " level " << level;
    }
  }
}

class DepthPyramidGl : public test::GlTest {};

TEST_F(DepthPyramidGl, EqualsTheTwinBitForBitAtAnySizeWithAndWithoutTheMinFilter) {
  for (const ScreenSize size : kSizes) {
    for (const DepthSource source : {DepthSource::kAll, DepthSource::kCovered}) {
      for (const bool fastPaths : {false, true}) {
        const GivenDepth depth(size, structuredDepth(size, size.width + 5), source, fastPaths);
        for (std::uint32_t level = 1; level < depth.pass.layout().levels; ++level) {
          const std::span<const float> expected = depth.reference.level(level);
          const std::vector<float> actual = depth.pass.readLevel(level);
          EXPECT_TRUE(std::equal(actual.begin(), actual.end(), expected.begin(), expected.end()))
              << size.width << "x" << size.height << " level " << level << " fast " << fastPaths;
        }
      }
    }
  }
}

}  // namespace
}  // namespace jalousie::visibility
