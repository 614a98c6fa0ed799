// Pictures of scenes whose differences are known.
#include "picture_difference.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace jalousie::bench {
namespace {

/// Two squares of different colours at z = 0, from (0, 0) to (2, 1). @param right  whether the second one is there
asset::SceneFile squares(const glm::vec4& rightColor, bool right = true) {
  asset::SceneFile scene;
  scene.materials.resize(2);
  scene.materials[0].baseColor = {1, 0, 0, 1};
  scene.materials[1].baseColor = rightColor;
  asset::Mesh mesh;
  for (std::uint32_t k = 0; k < (right ? 2U : 1U); ++k) {
    const auto x = static_cast<float>(k);
    asset::Primitive square;
    square.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    square.normals.assign(4, {0, 0, 1});
    square.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    square.colors.assign(4, glm::vec4(1.0F));
    square.indices = {0, 1, 2, 0, 2, 3};
    square.material = k;
    mesh.primitives.push_back(square);
  }
  scene.meshes = {mesh};
  scene.chains = {{"squares", {{0, 0.0F}}}};
  scene.instances = {{0, glm::mat4(1.0F)}};
  return scene;
}

PictureDifference differenceOf(const asset::SceneFile& reference, const asset::SceneFile& other) {
  const PictureScene a(reference, 0);
  const PictureScene b(other, 0);
  PictureDifference difference;
  for (const bake::RasterView& view : fittedViews(a, 32))
    difference.add(drawPicture(a, view), drawPicture(b, view));
  return difference;
}

TEST(PictureDifference, ThereAre26DirectionsAllDifferent) {
  const auto directions = pictureDirections();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(glm::length(directions[i]), 1.0, 1e-12);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT(glm::distance(directions[i], directions[k]), 0.1);
  }
}

TEST(PictureDifference, EqualScenesDoNotDiffer) {
  const PictureDifference difference = differenceOf(squares({0, 1, 0, 1}), squares({0, 1, 0, 1}));
  EXPECT_GT(difference.covered, 10'000U);
  EXPECT_EQ(difference.silhouettePercent(), 0.0);
  EXPECT_EQ(difference.colorPercent(), 0.0);
}

TEST(PictureDifference, HalfOfASurfaceThatIsMissingIsHalfOfTheSilhouette) {
  EXPECT_NEAR(differenceOf(squares({1, 0, 0, 1}), squares({1, 0, 0, 1}, false)).silhouettePercent(), 50.0, 2.0);
  // The view fits the reference: of what is beside it, only the part within the picture counts.
  EXPECT_GT(differenceOf(squares({1, 0, 0, 1}, false), squares({1, 0, 0, 1})).silhouettePercent(), 10.0);
}

TEST(PictureDifference, AColorThatChangesOnHalfOfASurface) {
  const PictureDifference difference = differenceOf(squares({1, 1, 1, 1}), squares({1, 1, 0, 1}));
  EXPECT_EQ(difference.silhouettePercent(), 0.0);
  EXPECT_GT(difference.colorPercent(), 6.0);   // a sixth of the range where the light comes from the front,
  EXPECT_LT(difference.colorPercent(), 16.7);  // and less where it grazes
}

TEST(PictureDifference, AMaskMakesHoles) {
  asset::SceneFile masked = squares({1, 1, 1, 1});
  ImageRgba8 image{2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};
  masked.images = SharedVector<ImageRgba8>(std::vector<ImageRgba8>{image});
  for (asset::Material& material : masked.materials) {
    material.baseTexture.emplace();
    material.alphaMode = asset::AlphaMode::kMask;
  }
  EXPECT_NEAR(differenceOf(squares({1, 1, 1, 1}), masked).silhouettePercent(), 50.0, 3.0);
  for (asset::Material& material : masked.materials)
    material.alphaMode = asset::AlphaMode::kOpaque;
  EXPECT_EQ(differenceOf(squares({1, 1, 1, 1}), masked).silhouettePercent(), 0.0);
}

TEST(PictureDifference, InstancesAreDrawnWhereTheyAre) {
  asset::SceneFile moved = squares({1, 1, 1, 1});
  moved.instances[0].worldFromObject[3].x = 1.0F;
  EXPECT_GT(differenceOf(squares({1, 1, 1, 1}), moved).silhouettePercent(), 50.0);
}

}  // namespace
}  // namespace jalousie::bench
