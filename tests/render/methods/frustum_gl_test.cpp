// Frustum culling: what the CPU twin finds outside is left out, and no pixel changes.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"
#include "visibility/classify_reference.h"
#include "visibility/frame_counters.h"

namespace jalousie::render {
namespace {

TEST_F(MethodGl, FrustumLeavesOutWhatTheTwinFindsOutside) {
  FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
  settle(renderer, CullMode::kFrustum, 1);
  const std::vector<gpu::uint> marks = renderer.readMarks();
  for (gpu::uint object = 0; object < scene_.objects.size(); ++object) {
    const gpu::uint verdict = visibility::classifyObject(scene_, renderer.cullView(), object, {}).state.verdict;
    EXPECT_NE(verdict == gpu::kVerdictOutside, visibility::isDrawn(marks[object], traitsOf(CullMode::kFrustum)))
        << object;
  }
}

TEST_F(MethodGl, FrustumChangesNoPixel) {
  FrameRenderer culled(scene_, kMethodWidth, kMethodHeight);
  FrameRenderer everything(scene_, kMethodWidth, kMethodHeight);
  EXPECT_LT(settle(culled, CullMode::kFrustum, 1).drawn, settle(everything, CullMode::kFull, 1).drawn);
  EXPECT_EQ(culled.readImage().pixels, everything.readImage().pixels);
}

}  // namespace
}  // namespace jalousie::render
