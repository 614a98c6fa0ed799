// What the tests of groups promise: a culled triangle cannot become a front face on the screen.
#include "visibility/face_reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/scenes.h"

namespace jalousie::visibility {
namespace {

constexpr glm::vec2 kScreen(640.0F, 360.0F);

scene::SceneData groupedSpheres(std::uint64_t seed, asset::FaceGrouping grouping) {
  asset::SceneFile file = test::randomSpheres(60, 6.0F, seed);
  test::groupFaces(file, grouping);
  return scene::buildScene(file, {.faces = true});
}

gpu::CullView viewOf(const scene::Camera& camera) {
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, kScreen.x / kScreen.y);
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.forwardWorld = glm::vec4(camera.forwardWorld(), camera.isOrthographic() ? 1.0F : 0.0F);
  view.focalPixels = scene::focalPixels(camera, glm::uvec2(kScreen));
  return view;
}

scene::Camera randomCamera(Random& random, const Aabb& world) {
  const float reach = std::exp2(random.uniform(-1.0F, 3.0F)) * world.diagonal();
  const auto point = [&](float by) {
    return glm::vec3(random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by));
  };
  scene::Camera camera = scene::lookAt(point(reach), point(4.0F), world);
  if (random.below(4) == 0) {
    camera.halfSize = glm::vec2(8.0F, 4.5F);
    camera.zNear = 0.0F;
  }
  return camera;
}

/// What one instance draws, as indices of the scene.
std::vector<bool> drawnIndices(const scene::SceneData& scene, const FaceCommands& commands) {
  std::vector<bool> drawn(scene.indices.size(), false);
  for (const auto& list : commands.commands)
    for (const gpu::DrawCommand& command : list)
      for (gpu::uint i = 0; i < command.count; ++i)
        drawn[command.firstIndex + i] = true;
  return drawn;
}

/// Twice the area of a triangle in the units of a rasteriser's grid of 1/256 pixel, after its vertices were rounded.
/// Positive: counter-clockwise, as the object's front faces are, also if the transform mirrors.
double snappedArea(const scene::SceneData& scene, const gpu::CullView& view, const gpu::Object& object,
                   const gpu::Lod& lod, std::size_t firstIndex) {
  glm::dvec2 corner[3];
  const glm::mat4 worldFromObject = scene::worldFromObject(scene.transforms[object.transform]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = static_cast<std::size_t>(lod.baseVertex) + scene.indices[firstIndex + k];
    const glm::vec3 position = scene.vertices[vertex].position;
    const glm::vec4 clip = view.clipFromWorld * (worldFromObject * glm::vec4(position, 1.0F));
    const glm::vec2 window = (glm::vec2(clip) / clip.w * 0.5F + 0.5F) * kScreen;
    corner[k] = glm::round(glm::dvec2(window) * 256.0);
  }
  const glm::dvec2 u = corner[1] - corner[0];
  const glm::dvec2 v = corner[2] - corner[0];
  return (u.x * v.y - u.y * v.x) * (glm::determinant(glm::mat3(worldFromObject)) < 0.0F ? -1.0 : 1.0);
}

TEST(FaceReference, CulledTrianglesAreNoFrontFacesAfterTheirVerticesWereRounded) {
  Random random(7);
  for (const asset::FaceGrouping grouping :
       {asset::FaceGrouping::kMasks, asset::FaceGrouping::kClusters, asset::FaceGrouping::kMeshlets}) {
    const scene::SceneData scene = groupedSpheres(11, grouping);
    ASSERT_EQ(scene.chains[0].lodCount, scene.lods.size());
    std::uint64_t culled[5] = {};
    for (int i = 0; i < 400; ++i) {
      const gpu::CullView view = viewOf(randomCamera(random, scene.boundsWorld));
      const gpu::uint object = random.below(static_cast<gpu::uint>(scene.objects.size()));
      const gpu::uint level = random.below(scene.chains[0].lodCount);
      const gpu::Lod& lod = scene.lods[level];
      for (gpu::uint test = gpu::kFacesMask; test <= gpu::kFacesCone; ++test) {
        const FaceInstance instance{object, 2 * level};
        const FaceCommands commands =
            cullFaces(scene.faces, scene.transforms, view, {test, 1000, 0, 0}, std::span(&instance, 1));
        EXPECT_EQ(commands.tested, lod.solidCount / 3);
        culled[test] += commands.culled;
        const std::vector<bool> drawn = drawnIndices(scene, commands);
        for (gpu::uint t = lod.firstIndex; t < lod.firstIndex + lod.solidCount; t += 3) {
          if (drawn[t]) continue;
          ASSERT_LE(snappedArea(scene, view, scene.objects[object], lod, t), 0.0)
              << "test " << test << " level " << level << " triangle " << t / 3;
        }
      }
    }
    for (gpu::uint test = gpu::kFacesMask; test <= gpu::kFacesCone; ++test)
      EXPECT_GT(culled[test], 1000U) << test;
  }
}

TEST(FaceReference, TheTreeCullsAtLeastWhatItsGroupsWould) {
  const scene::SceneData scene = groupedSpheres(12, asset::FaceGrouping::kClusters);
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const gpu::CullView view = viewOf(randomCamera(random, scene.boundsWorld));
    const FaceInstance instance{random.below(static_cast<gpu::uint>(scene.objects.size())), 0};
    const auto culled = [&](gpu::uint test) {
      return cullFaces(scene.faces, scene.transforms, view, {test, 1000, 0, 0}, std::span(&instance, 1)).culled;
    };
    // A node that is all front faces has no group that is all back faces, and a back node has back groups.
    EXPECT_EQ(culled(gpu::kFacesTree), culled(gpu::kFacesCluster));
  }
}

TEST(FaceReference, FewRangesOnlyDrawMore) {
  const scene::SceneData scene = groupedSpheres(13, asset::FaceGrouping::kClusters);
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const gpu::CullView view = viewOf(randomCamera(random, scene.boundsWorld));
    const FaceInstance instance{random.below(static_cast<gpu::uint>(scene.objects.size())), 0};
    const auto commandsWith = [&](gpu::uint most) {
      return cullFaces(scene.faces, scene.transforms, view, {gpu::kFacesCluster, most, 0, 0}, std::span(&instance, 1));
    };
    const std::vector<bool> all = drawnIndices(scene, commandsWith(1000));
    for (const gpu::uint most : {1U, 2U, 5U}) {
      const FaceCommands few = commandsWith(most);
      EXPECT_LE(few.commands[0].size(), most);
      const std::vector<bool> drawn = drawnIndices(scene, few);
      for (std::size_t k = 0; k < all.size(); ++k)
        ASSERT_LE(all[k], drawn[k]);
    }
  }
}

TEST(FaceReference, AnEyeInsideASphereCullsNothingInFrontOfIt) {
  asset::SceneFile file = test::sphereChain(1);
  test::groupFaces(file, asset::FaceGrouping::kClusters);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(5.0F));
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  const gpu::CullView view = viewOf(scene::lookAt({0.1F, 0.2F, 0.3F}, {4.0F, 1.0F, 0.0F}, scene.boundsWorld));
  const FaceInstance instance{0, 0};
  // All triangles before the eye are back faces of a single-sided surface, so that most of them are culled.
  const FaceCommands commands =
      cullFaces(scene.faces, scene.transforms, view, {gpu::kFacesCluster, 1000, 0, 0}, std::span(&instance, 1));
  EXPECT_GT(commands.culled, 0U);
}

TEST(FaceReference, DegenerateTransformsCullNothing) {
  asset::SceneFile file = test::sphereChain(1);
  test::groupFaces(file, asset::FaceGrouping::kClusters);
  test::addInstance(file, 0, {0, 0, 0}, {1.0F, 0.0F, 1.0F});
  test::addInstance(file, 0, {0, 0, 0}, {0.0F, 0.0F, 0.0F});
  test::addInstance(file, 0, {0, 0, 0}, {1e-30F, 1e-30F, 1e-30F});
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  const gpu::CullView view = viewOf(scene::lookAt({0.0F, 3.0F, 8.0F}, {0.0F, 0.0F, 0.0F}, scene.boundsWorld));
  for (gpu::uint object = 0; object < 3; ++object) {
    for (gpu::uint test = gpu::kFacesMask; test <= gpu::kFacesCone; ++test) {
      const FaceInstance instance{object, 0};
      EXPECT_EQ(cullFaces(scene.faces, scene.transforms, view, {test, 1000, 0, 0}, std::span(&instance, 1)).culled, 0U);
    }
  }
}

}  // namespace
}  // namespace jalousie::visibility
