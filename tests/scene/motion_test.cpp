// Animations that play: the same poses as a scene that is read at a time, and boxes that hold them.
#include <gtest/gtest.h>

#include <vector>

#include "asset/scene_file.h"
#include "scene/motion_reference.h"
#include "scene/patch_base.h"
#include "scene/scene_data.h"
#include "support/animated_model.h"

namespace jalousie::scene {
namespace {

using test::AnimatedContent;

asset::SceneFile fileAt(const tinygltf::Model& model, double seconds) {
  return asset::readScene(model, "model.glb", {}, {.check = {}, .seconds = seconds});
}

asset::SceneFile playing(const tinygltf::Model& model) {
  return asset::readScene(model, "model.glb", {}, {.check = {}, .seconds = {}, .plays = true});
}

/// All places at which some level of an object shows a vertex, in the world, relative to a point of the document.
std::vector<glm::dvec3> placesOf(const SceneData& scene, std::uint32_t object) {
  std::vector<glm::dvec3> places;
  const glm::mat4 world = worldFromObject(scene.transforms[scene.objects[object].transform]);
  const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
  for (gpu::uint level = 0; level < chain.lodCount; ++level) {
    const gpu::Lod& lod = scene.lods[chain.firstLod + level];
    for (gpu::uint i = 0; i < 3 * lod.triangleCount; ++i) {
      const std::uint32_t v = scene.indices[lod.firstIndex + i] + static_cast<std::uint32_t>(lod.baseVertex);
      places.emplace_back(glm::dvec3(glm::vec3(world * glm::vec4(scene.vertices[v].position, 1.0F))) +
                          scene.originWorld);
    }
  }
  return places;
}

double largestDistance(const SceneData& a, const SceneData& b) {
  EXPECT_EQ(a.objects.size(), b.objects.size());
  double largest = 0.0;
  for (std::uint32_t object = 0; object < a.objects.size(); ++object) {
    const std::vector<glm::dvec3> left = placesOf(a, object);
    const std::vector<glm::dvec3> right = placesOf(b, object);
    EXPECT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
      largest = std::max(largest, glm::distance(left[i], right[i]));
  }
  EXPECT_EQ(a.loose.vertices.size(), b.loose.vertices.size());
  for (std::size_t v = 0; v < std::min(a.loose.vertices.size(), b.loose.vertices.size()); ++v)
    largest = std::max(largest, glm::distance(glm::dvec3(a.loose.vertices[v].position) + a.originWorld,
                                              glm::dvec3(b.loose.vertices[v].position) + b.originWorld));
  return largest;
}

/// Steps of a packed normal between two vertices.
int normalSteps(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (int k = 0; k < 3; ++k) {
    const auto part = [&](std::uint32_t packed) { return static_cast<std::int32_t>(packed << (22 - 10 * k)) >> 22; };
    most = std::max(most, std::abs(part(a) - part(b)));
  }
  return most;
}

const std::vector<AnimatedContent>& contents() {
  static const std::vector<AnimatedContent> kContents = {
      {.seed = 1},
      {.seed = 2, .flat = true},
      {.seed = 3, .loose = true, .levels = true},
      {.seed = 4, .nodes = 40, .skinned = 0, .morphed = 0, .levels = true},
      {.seed = 5, .nodes = 2, .skinned = 4, .morphed = 4, .flat = true, .loose = true, .levels = true},
  };
  return kContents;
}

constexpr double kTimes[] = {0.0, 0.13, 0.5, 0.77, 1.0, 1.49, 1.99, 2.0, 7.0};

TEST(Motion, PosesAreThoseOfASceneThatIsReadAtTheTime) {
  for (const AnimatedContent& content : contents()) {
    const tinygltf::Model model = test::animatedModel(content);
    SceneData scene = buildScene(playing(model));
    ASSERT_FALSE(scene.motion.empty());
    EXPECT_EQ(scene.motion.lastKey, test::kAnimatedSeconds);
    for (const double seconds : kTimes) {
      SCOPED_TRACE(testing::Message() << "seed " << content.seed << " at " << seconds);
      const SceneData expected = buildScene(fileAt(model, seconds));
      poseScene(scene, static_cast<float>(seconds));
      EXPECT_LT(largestDistance(scene, expected), 5e-5);
      for (std::size_t v = 0; v < expected.vertices.size(); ++v)
        ASSERT_LE(normalSteps(scene.vertices[v].normal, expected.vertices[v].normal), 1) << v;
    }
  }
}

TEST(Motion, BoxesHoldEveryPose) {
  for (const AnimatedContent& content : contents()) {
    SceneData scene = buildScene(playing(test::animatedModel(content)));
    for (float seconds = 0.0F; seconds < 2.1F; seconds += 0.037F) {
      poseScene(scene, seconds);
      for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
        for (gpu::uint level = 0; level < chain.lodCount; ++level) {
          const gpu::Lod& lod = scene.lods[chain.firstLod + level];
          for (gpu::uint i = 0; i < 3 * lod.triangleCount; ++i) {
            const glm::vec3 p =
                scene.vertices[scene.indices[lod.firstIndex + i] + static_cast<std::uint32_t>(lod.baseVertex)].position;
            for (int k = 0; k < 3; ++k) {
              ASSERT_GE(p[k], chain.boundsMinObject[k]) << "seed " << content.seed << " object " << object;
              ASSERT_LE(p[k], chain.boundsMaxObject[k]) << "seed " << content.seed << " object " << object;
            }
          }
        }
      }
    }
  }
}

/// A packed normal as a vector.
glm::vec3 normalOf(std::uint32_t packed) {
  const auto part = [&](int k) {
    return static_cast<float>(static_cast<std::int32_t>(packed << (22 - 10 * k)) >> 22) / 511.0F;
  };
  return {part(0), part(1), part(2)};
}

/// Box of the curved surface of a chain's base mesh.
Aabb curvedBounds(const SceneData& scene, const gpu::Chain& chain) {
  const gpu::Lod& base = scene.lods[chain.patchLod];
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> indices;
  for (gpu::uint i = 0; i < 3 * base.triangleCount; ++i) {
    const Vertex& vertex =
        scene.vertices[scene.indices[base.firstIndex + i] + static_cast<std::uint32_t>(base.baseVertex)];
    indices.push_back(i);
    positions.push_back(vertex.position);
    normals.push_back(normalOf(vertex.normal));
  }
  return phongBounds(positions, normals, indices, kPhongAlpha);
}

TEST(Motion, BoxesHoldEveryCurvedPose) {
  for (const AnimatedContent& content : contents()) {
    SceneData scene = buildScene(playing(test::animatedModel(content)), {.patches = true});
    for (float seconds = 0.0F; seconds < 2.1F; seconds += 0.17F) {
      poseScene(scene, seconds);
      for (const gpu::BentChain& bent : scene.motion.chains) {
        const gpu::Chain& chain = scene.chains[bent.chain];
        const Aabb curved = curvedBounds(scene, chain);
        for (int k = 0; k < 3; ++k) {
          ASSERT_GE(curved.min[k], chain.boundsMinObject[k] - 1e-4F) << "seed " << content.seed << " at " << seconds;
          ASSERT_LE(curved.max[k], chain.boundsMaxObject[k] + 1e-4F) << "seed " << content.seed << " at " << seconds;
        }
      }
    }
  }
}

TEST(Motion, BoxesOfSkinsAreNotMuchLargerThanTheirPoses) {
  const tinygltf::Model model = test::animatedModel({.seed = 6, .nodes = 0, .skinned = 6, .morphed = 0});
  SceneData scene = buildScene(playing(model));
  double boxes = 0.0;
  double poses = 0.0;
  for (float seconds = 0.0F; seconds < 2.0F; seconds += 0.1F) {
    poseScene(scene, seconds);
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
      const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
      boxes += static_cast<double>(Aabb{glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)}.diagonal());
      Aabb pose;
      for (const glm::dvec3& place : placesOf(scene, object))
        pose.add(glm::vec3(place));
      poses += static_cast<double>(pose.diagonal());
    }
  }
  EXPECT_LT(boxes, 1.6 * poses);
}

TEST(Motion, ASceneFarFromTheOriginMovesAsOneAtTheOrigin) {
  AnimatedContent content{.seed = 7, .loose = true, .levels = true};
  SceneData near = buildScene(playing(test::animatedModel(content)));
  content.place = {4e6, -3e6, 2e6};
  SceneData far = buildScene(playing(test::animatedModel(content)));
  ASSERT_NE(far.originWorld, glm::dvec3(0.0));
  for (const float seconds : {0.0F, 0.7F, 1.3F}) {
    poseScene(near, seconds);
    poseScene(far, seconds);
    far.originWorld -= content.place;
    EXPECT_LT(largestDistance(near, far), 1e-4);
    far.originWorld += content.place;
  }
}

TEST(Motion, TheBoundsOfTheSceneHoldAllPoses) {
  SceneData scene = buildScene(playing(test::animatedModel({.seed = 8, .loose = true})));
  for (float seconds = 0.0F; seconds < 2.0F; seconds += 0.1F) {
    poseScene(scene, seconds);
    const float slack = 0.02F * scene.boundsWorld.diagonal();
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
      for (const glm::dvec3& place : placesOf(scene, object)) {
        for (int k = 0; k < 3; ++k) {
          ASSERT_GT(place[k], static_cast<double>(scene.boundsWorld.min[k] - slack));
          ASSERT_LT(place[k], static_cast<double>(scene.boundsWorld.max[k] + slack));
        }
      }
    }
  }
}

TEST(Motion, HiddenInstancesDoNotMove) {
  const asset::SceneFile file = playing(test::animatedModel({.seed = 9, .loose = true}));
  ASSERT_GT(file.motion.instances.size(), 1U);
  const std::uint32_t hidden = file.motion.instances.front().index;
  SceneData all = buildScene(file);
  SceneData some = buildScene(file, {.hidden = {hidden}});
  EXPECT_EQ(some.motion.transformCount, all.motion.transformCount - 1);
  poseScene(all, 0.9F);
  poseScene(some, 0.9F);
  for (const gpu::Object& object : some.objects) {
    const auto same = std::find_if(all.objects.begin(), all.objects.end(),
                                   [&](const gpu::Object& other) { return other.owner == object.owner; });
    EXPECT_EQ(worldFromObject(some.transforms[object.transform]), worldFromObject(all.transforms[same->transform]));
  }
}

TEST(Motion, BentMeshesHaveOneCell) {
  const asset::SceneFile file = playing(test::animatedModel({.seed = 10, .nodes = 3, .levels = true}));
  const BuildOptions options{.cells = {CellOptions::Kind::kCount, 64}};
  SceneData scene = buildScene(file, options);
  ASSERT_FALSE(scene.cells.objects.empty());
  poseScene(scene, 0.5F);
  ASSERT_FALSE(scene.motion.chains.empty());
  for (const gpu::BentChain& bent : scene.motion.chains) {
    ASSERT_NE(bent.cellChain, gpu::kNoMotion);
    const gpu::Chain& cell = scene.cells.chains[bent.cellChain];
    EXPECT_EQ(cell.boundsMinObject, scene.chains[bent.chain].boundsMinObject);
    EXPECT_EQ(scene.cells.bounds[cell.firstLod].maxObject, scene.chains[bent.chain].boundsMaxObject);
    EXPECT_EQ(bent.cellLodCount, scene.chains[bent.chain].lodCount);
  }
}

TEST(Motion, WithoutAnimationsNothingPlays) {
  tinygltf::Model model = test::animatedModel({.seed = 11});
  model.animations.clear();
  EXPECT_TRUE(playing(model).motion.empty());
  EXPECT_TRUE(fileAt(test::animatedModel({.seed = 11}), 0.0).motion.empty());
}

}  // namespace
}  // namespace jalousie::scene
