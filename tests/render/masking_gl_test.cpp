// Frames with masked errors: open objects keep their level, partly covered ones may get a coarser one.
#include <gtest/gtest.h>

#include <vector>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/masking.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;
constexpr int kSettle = 8;  // frames

/// What a settled frame decided.
struct Decided {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
};

Decided decidedBy(const scene::SceneData& scene, const FrameOptions& options) {
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (int i = 0; i < kSettle; ++i)
    renderer.render(options, camera, camera);
  return {renderer.readStates(), renderer.readBoxes()};
}

FrameOptions optionsOf(CullMode mode, LodRule rule) {
  FrameOptions options;
  options.cullMode = mode;
  options.lodRule = rule;
  options.lvMeasure = rowOf(rule).measure;
  options.tau = 0.5F;
  return options;
}

class MaskingGl : public test::GlTest {};

TEST_F(MaskingGl, PartlyCoveredObjectsGetCoarserAndOpenOnesStay) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(600, 9.0F, 3));
  for (const CullMode mode : {CullMode::kHiz, CullMode::kHom, CullMode::kHomDepth}) {
    FrameOptions options = optionsOf(mode, LodRule::kPixelError);
    const Decided plain = decidedBy(scene, options);
    options.masking = true;
    const Decided masked = decidedBy(scene, options);
    std::size_t coarser = 0;
    for (std::size_t i = 0; i < plain.states.size(); ++i) {
      const gpu::uint verdict = masked.states[i].verdict;
      if (verdict != gpu::kVerdictOpen && verdict != gpu::kVerdictPartial) continue;
      if (plain.states[i].verdict != verdict) continue;
      EXPECT_GE(masked.states[i].lod, plain.states[i].lod) << "object " << i << " mode " << rowOf(mode).name;
      if (visibility::maskingFactor(masked.boxes[i].cover) <= 1.0F) {
        EXPECT_EQ(masked.states[i].lod, plain.states[i].lod) << "object " << i << " mode " << rowOf(mode).name;
      }
      coarser += masked.states[i].lod > plain.states[i].lod ? 1 : 0;
    }
    EXPECT_GT(coarser, 5U) << rowOf(mode).name;
  }
}

std::uint64_t drawnTriangles(const scene::SceneData& scene, const Decided& decided) {
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < decided.states.size(); ++i) {
    const gpu::uint verdict = decided.states[i].verdict;
    if (verdict != gpu::kVerdictOpen && verdict != gpu::kVerdictPartial) continue;
    triangles += scene.lods[scene.chains[scene.objects[i].chain].firstLod + decided.states[i].lod].triangleCount;
  }
  return triangles;
}

TEST_F(MaskingGl, RulesThatCountPixelsDrawFewerTriangles) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(600, 9.0F, 3));
  for (const CullMode mode : {CullMode::kHiz, CullMode::kHom}) {
    for (const LodRule rule : {LodRule::kLvError, LodRule::kPrice}) {
      FrameOptions options = optionsOf(mode, rule);
      const std::uint64_t plain = drawnTriangles(scene, decidedBy(scene, options));
      options.masking = true;
      const std::uint64_t masked = drawnTriangles(scene, decidedBy(scene, options));
      EXPECT_LT(static_cast<double>(masked), 0.98 * static_cast<double>(plain))
          << rowOf(mode).name << ", " << rowOf(rule).name;
    }
  }
}

TEST_F(MaskingGl, WithoutTheOptionNoBlockIsMeasuredAndNothingStaysOfIt) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 9.0F, 3));
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const LodRule rule : {LodRule::kPixelError, LodRule::kLvError, LodRule::kPrice}) {
    FrameRenderer renderer(scene, kWidth, kHeight);
    FrameOptions options = optionsOf(CullMode::kHiz, rule);
    const auto settled = [&](bool masking) {
      options.masking = masking;
      renderer.resetHistory();  // counts depend on the levels of the frames before
      for (int i = 0; i < kSettle; ++i)
        renderer.render(options, camera, camera);
      return renderer.readImage();
    };
    const ImageRgba8 never = settled(false);
    for (const gpu::ScreenBox& box : renderer.readBoxes())
      ASSERT_EQ(box.cover, gpu::kCoverOpen);
    EXPECT_FALSE(settled(true).pixels == never.pixels) << "masking changes nothing in this view";
    EXPECT_TRUE(settled(false).pixels == never.pixels) << rowOf(rule).name;
  }
}

TEST_F(MaskingGl, WithoutAnOcclusionTestAndWithChordsNothingChanges) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 9.0F, 5));
  FrameOptions frustum = optionsOf(CullMode::kFrustum, LodRule::kPixelError);
  FrameOptions chord = optionsOf(CullMode::kHiz, LodRule::kLvError);
  chord.lvMeasure = LvMeasure::kChord;
  for (FrameOptions options : {frustum, chord}) {
    const Decided plain = decidedBy(scene, options);
    options.masking = true;
    const Decided masked = decidedBy(scene, options);
    for (std::size_t i = 0; i < plain.states.size(); ++i)
      EXPECT_EQ(masked.states[i].lod, plain.states[i].lod) << "object " << i;
  }
}

}  // namespace
}  // namespace jalousie::render
