// Stored frames of the default mode, one per view.
#include <gtest/gtest.h>

#include <string>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/image_compare.h"
#include "support/stages.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 90;
constexpr std::uint32_t kFrames =
    2 * kCountInterval;  ///< the default follows pixel counts, which come every few frames

// Limits, where the usual ones of ImageLimits do not fit. A frame at 160 x 90 has 14,400 pixels; about 1,500 of them
// lie at silhouettes, where a driver may choose the other surface.
/// Shading: rounding is below 2, and a hundred silhouette pixels that change by 80 add 0.6. Texture filtering is not
/// used.
constexpr test::ImageLimits kShading{.mean = 0.8, .large = 24, .largeShare = 0.01, .maximum = 32};
/// Flat colours of states: one object of another level or verdict (1 % of the pixels, by 100) exceeds the mean.
constexpr test::ImageLimits kFlatColors{.mean = 0.8, .large = 24, .largeShare = 0.01, .maximum = 32};
/// Heat colours of a float: a step of one unit in the 8-bit ramp is up to 4 per channel; the colours are smooth.
constexpr test::ImageLimits kHeat{.mean = 1.0, .large = 24, .largeShare = 0.015, .maximum = 40};
/// Lines one pixel wide: OpenGL lets a driver place them half a pixel apart, so twice as many pixels may change.
constexpr test::ImageLimits kLines{.mean = 3.0, .large = 24, .largeShare = 0.05, .maximum = 64};

struct GoldenView {
  const char* name;
  View view;
  test::ImageLimits limits;
};

const GoldenView kViews[] = {
    {"shaded", View::kShaded, kShading},
    {"lod", View::kLod, kFlatColors},
    {"lv", View::kLv, kHeat},
    {"occlusion", View::kOcclusion, kHeat},
    {"phase", View::kPhase, kFlatColors},
    {"coverage", View::kCoverage, kHeat},
    {"holes", View::kHoles, kHeat},
    {"wireframe", View::kWireframe, kLines},
    {"overdraw", View::kOverdraw, kFlatColors},
    {"ghosts", View::kGhosts, kShading},
    {"levels", View::kLevels, kFlatColors},
    {"density", View::kDensity, kFlatColors},
};

class ViewsGoldenGl : public test::GlTest, public testing::WithParamInterface<GoldenView> {};

TEST_P(ViewsGoldenGl, DefaultModeLooksAsStored) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.2F, 8));
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  FrameOptions options;
  options.view = GetParam().view;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame)
    renderer.render(options, camera, camera);
  EXPECT_TRUE(test::matchesGolden(renderer.readImage(), std::string("default_") + GetParam().name, GetParam().limits));
}

std::string nameOf(const testing::TestParamInfo<GoldenView>& parameter) {
  return parameter.param.name;
}

INSTANTIATE_TEST_SUITE_P(Views, ViewsGoldenGl, testing::ValuesIn(kViews), nameOf);

TEST(ViewsGolden, EveryViewHasAStoredFrame) {
  EXPECT_EQ(std::size(kViews), viewTable().size());
}

}  // namespace
}  // namespace jalousie::render
