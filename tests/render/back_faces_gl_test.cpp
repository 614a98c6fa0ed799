// Pictures and depth with groups of back faces left out equal those without, bit for bit.
#include <gtest/gtest.h>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;
constexpr FaceCulling kTests[] = {FaceCulling::kMask, FaceCulling::kCluster, FaceCulling::kTree, FaceCulling::kCone};

/// Spheres, some mirrored and flattened, some around the camera's places; every other one double-sided or masked.
asset::SceneFile mixed(std::uint64_t seed) {
  asset::SceneFile file = test::randomSpheres(50, 4.0F, seed);
  file.materials.emplace_back().doubleSided = true;
  file.meshes.push_back({"boxes", {test::box({0.5F, 0.4F, 0.3F}), test::box({0.3F, 0.6F, 0.2F}, 1)}});
  file.chains.push_back({"boxes", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  const auto boxes = static_cast<std::uint32_t>(file.chains.size() - 1);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(3.0F));
  test::addInstance(file, 0, {0, 0, 9}, {-6.0F, 2.0F, 1.0F});
  test::addInstance(file, boxes, {1, 1, 1}, {2.0F, -1.0F, 1.0F}, 0.7F);
  test::addInstance(file, boxes, {-2, 0, 2}, {0.01F, 3.0F, 1.0F}, 1.7F);
  return file;
}

/// Around the scene, through it, and inside of spheres.
scene::Camera cameraAt(std::uint32_t frame, const scene::SceneData& scene) {
  Random random(100 + frame);
  const auto point = [&](float reach) {
    return glm::vec3(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
  };
  scene::Camera camera = scene::lookAt(point(frame % 3 == 0 ? 2.5F : 14.0F), point(2.0F), scene.boundsWorld);
  if (frame % 5 == 4) camera.halfSize = glm::vec2(6.0F, 4.0F);
  return camera;
}

class BackFacesGl : public test::GlTest {
 protected:
  /// @return  triangles that were left out
  static std::uint64_t compare(const scene::SceneData& scene, FrameOptions options, std::uint32_t frames,
                               const RendererOptions& made = {}) {
    FrameRenderer plain(scene, kWidth, kHeight, made);
    FrameRenderer culled(scene, kWidth, kHeight, made);
    std::uint64_t left = 0;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      const scene::Camera camera = cameraAt(frame, scene);
      options.faceCulling = FaceCulling::kOff;
      plain.render(options, camera, camera);
      options.faceCulling = kTests[frame % 4];
      culled.render(options, camera, camera);
      const bool equal = plain.readImage().pixels == culled.readImage().pixels;
      EXPECT_TRUE(equal) << "frame " << frame;
      EXPECT_EQ(plain.readDepth() == culled.readDepth(), true) << "frame " << frame;
      if (!equal) return 0;
      const FrameStatistics statistics = culled.readStatistics();
      EXPECT_EQ(statistics.triangles, plain.readStatistics().triangles);
      EXPECT_LE(statistics.facesCulled, statistics.facesTested);
      left += statistics.facesCulled;
    }
    return left;
  }
};

TEST_F(BackFacesGl, PicturesEqualThoseWithoutInEveryModeAndLevelRule) {
  asset::SceneFile file = mixed(31);
  test::groupFaces(file, asset::FaceGrouping::kClusters);
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  for (const CullModeRow& mode : cullModeTable()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      SCOPED_TRACE(testing::Message() << mode.name << ' ' << rule.name);
      FrameOptions options;
      options.cullMode = mode.id;
      options.lodRule = rule.id;
      options.lvMeasure = rule.measure;
      options.calm = rule.followsError;
      if (wantsBlock(options) && !mode.testsOcclusion) continue;
      EXPECT_GT(compare(scene, options, 4), 0U);  // each test once
    }
  }
}

TEST_F(BackFacesGl, PicturesEqualThoseWithoutForEveryGroupingAndCells) {
  for (const asset::FaceGrouping grouping : asset::kFaceGroupings) {
    for (const std::uint32_t perCell : {0U, 24U}) {
      asset::SceneFile file = mixed(32);
      if (grouping != asset::FaceGrouping::kOff) test::groupFaces(file, grouping);
      scene::BuildOptions build{.faces = true};
      if (perCell > 0) build.cells = {scene::CellOptions::Kind::kCount, perCell};
      const scene::SceneData scene = scene::buildScene(file, build);
      FrameOptions options;
      options.lodRule = LodRule::kFinest;
      const std::uint64_t left = compare(scene, options, 20);
      EXPECT_EQ(left > 0, grouping != asset::FaceGrouping::kOff || perCell > 0);
    }
  }
}

TEST_F(BackFacesGl, PicturesEqualThoseWithoutOnEveryPath) {
  asset::SceneFile file = mixed(33);
  test::groupFaces(file, asset::FaceGrouping::kMasks);
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  for (const bool fast : {true, false})
    for (const visibility::Submission submission :
         {visibility::Submission::kInstanced, visibility::Submission::kPerObject})
      EXPECT_GT(compare(scene, {}, 8, {.submission = submission, .fastPaths = fast}), 0U);
}

TEST_F(BackFacesGl, FiguresSayWhatIsLeftWhole) {
  asset::SceneFile file;
  file.materials.resize(3);
  file.materials[1].doubleSided = true;
  file.materials[2].alphaMode = asset::AlphaMode::kBlend;
  file.meshes = {{"sphere", {test::sphere(24, 12), test::sphere(12, 8, 1), test::sphere(6, 4, 2)}}};
  file.chains = {{"sphere", {{0, 0.0F}}}};
  test::groupFaces(file, asset::FaceGrouping::kClusters);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1.0F));
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 1, 4}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options;
  options.faceCulling = FaceCulling::kCluster;
  renderer.render(options, camera, camera);
  FrameStatistics statistics = renderer.readStatistics();
  EXPECT_EQ(statistics.facesTested, 2U * 24 * 11);
  EXPECT_EQ(statistics.facesWhole, 2U * (12 * 7 + 6 * 3)) << "double-sided and blended";
  EXPECT_EQ(statistics.facesTested + statistics.facesWhole, statistics.triangles);
  EXPECT_GT(statistics.facesCulled, statistics.facesTested / 4);
  EXPECT_LT(statistics.facesCulled, statistics.facesTested * 13 / 20)
      << "from a finite distance more than half of a sphere";
  options.faceCulling = FaceCulling::kOff;
  renderer.render(options, camera, camera);
  statistics = renderer.readStatistics();
  EXPECT_EQ(statistics.facesTested + statistics.facesCulled + statistics.facesWhole, 0U);
}

}  // namespace
}  // namespace jalousie::render
