// The factor of masking in GLSL against its CPU twin, for all kinds of covers.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "core/random.h"

#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "visibility/masking.h"

namespace jalousie::visibility {
namespace {

constexpr const char* kKernel = R"(#version 450 core
#include "shared/limits.h"
#include "shared/traits.h"
bool hasTrait(uint trait) { return true; }
#include "lib/masking.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer CoverBlock { uint covers[]; };
layout(std430, binding = 1) writeonly buffer FactorBlock { float factors[]; };
void main() { factors[gl_GlobalInvocationID.x] = maskingFactor(covers[gl_GlobalInvocationID.x]); }
)";

/// Every chord that a half holds with a share of three quarters, every share with a chord of two pixels, and random
/// bits. NaN, infinities, negative and denormal numbers are among them.
std::vector<gpu::uint> allKinds() {
  constexpr gpu::uint kThreeQuarters = 0x3a00;
  constexpr gpu::uint kTwo = 0x4000;
  std::vector<gpu::uint> covers;
  for (gpu::uint half = 0; half < 0x10000; ++half) {
    covers.push_back(half << 16 | kThreeQuarters);
    covers.push_back(kTwo << 16 | half);
  }
  Random random(77);
  for (int i = 0; i < 0x10000; ++i)
    covers.push_back(random.below(0xffffffffU));
  return covers;
}

class MaskingGl : public test::GlTest {};

TEST_F(MaskingGl, FactorsOfAllCoversEqualTheTwins) {
  const std::vector<gpu::uint> covers = allKinds();
  const test::TemporaryFolder folder;
  std::ofstream(folder / "factors.comp") << kKernel;
  const gl::Program program({"factors", {"factors.comp"}, {}}, gl::ShaderLibrary(folder.path()));
  const gl::Buffer given = gl::Buffer::fromArray(std::span<const gpu::uint>(covers), "covers");
  const std::vector<float> none(covers.size(), -1.0F);
  const gl::Buffer factors = gl::Buffer::fromArray(std::span<const float>(none), "factors");
  program.use();
  given.bindStorage(0);
  factors.bindStorage(1);
  glDispatchCompute(static_cast<GLuint>(covers.size() / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto actual = factors.read<float>(covers.size());
  const float most = std::pow(gpu::kMaskingPixels, gpu::kMaskingExponent);
  for (std::size_t i = 0; i < covers.size(); ++i) {
    const float expected = maskingFactor(covers[i]);
    ASSERT_NEAR(actual[i], expected, 1e-4F * expected) << std::hex << covers[i];
    ASSERT_TRUE(expected >= 1.0F && expected <= most) << std::hex << covers[i];
  }
}

}  // namespace
}  // namespace jalousie::visibility
