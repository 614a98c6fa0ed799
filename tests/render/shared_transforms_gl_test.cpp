// Objects refer to transforms by index: a scene whose objects share transforms, in any order, gives the same decisions
// and pictures as the scene that stores one transform per object.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "policy/frame_policy.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"

namespace jalousie::render {
namespace {

using scene::SceneData;

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 90;

/// Spheres with a box around the equator of each: two chains, two objects per transform.
SceneData expandedScene() {
  asset::SceneFile file = test::randomSpheres(60, 5.0F, 12);
  file.meshes.push_back({"ring", {test::box({1.3F, 0.2F, 1.3F})}});
  file.chains.push_back({"ring", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  const std::size_t spheres = file.instances.size();
  for (std::size_t i = 0; i < spheres; ++i)
    file.instances.push_back({1, file.instances[i].worldFromObject});
  return scene::buildScene(file);
}

bool sameBytes(const gpu::Transform& a, const gpu::Transform& b) {
  return std::memcmp(&a, &b, sizeof(gpu::Transform)) == 0;
}

/// The same objects with every transform stored once, from the last to the first, behind one that nothing refers to.
SceneData sharedScene(const SceneData& expanded) {
  SceneData shared = expanded;
  shared.transforms.assign(1, scene::makeTransform(glm::mat4(3.0F)));
  for (std::size_t i = expanded.objects.size(); i-- > 0;) {
    const gpu::Transform& wanted = expanded.transforms[expanded.objects[i].transform];
    gpu::uint index = 1;
    while (index < shared.transforms.size() && !sameBytes(shared.transforms[index], wanted))
      ++index;
    if (index == shared.transforms.size()) shared.transforms.push_back(wanted);
    shared.objects[i].transform = index;
  }
  return shared;
}

template <class T>
bool equalBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expectSameFrame(const FrameRenderer& actual, const FrameRenderer& expected) {
  EXPECT_TRUE(equalBytes(actual.readStates(), expected.readStates()));
  EXPECT_TRUE(equalBytes(actual.readBoxes(), expected.readBoxes()));
  EXPECT_EQ(actual.readMarks(), expected.readMarks());
  EXPECT_EQ(actual.readImage().pixels, expected.readImage().pixels);
}

TEST(SharedTransforms, TwinDecidesAsForTheExpandedScene) {
  const SceneData expanded = expandedScene();
  const SceneData shared = sharedScene(expanded);
  ASSERT_EQ(shared.transforms.size(), expanded.transforms.size() / 2 + 1);
  gpu::CullView view{};
  const scene::Camera camera = scene::lookAt({1, 2, 9}, {0, 0, 0}, expanded.boundsWorld);
  view.clipFromWorld = scene::clipFromWorld(camera, 16.0F / 9.0F);
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.viewportWidth = kWidth;
  view.viewportHeight = kHeight;
  view.traits = traitsOf(CullMode::kFrustum) | traitsOf(LodRule::kPixelError);
  view.maxTessellation = gpu::kMaxTessellationLevel;
  view.focalPixels = scene::focalPixels(camera, {kWidth, kHeight});
  view.tau = 1.0F;
  for (gpu::uint i = 0; i < expanded.objects.size(); ++i) {
    const visibility::ObjectDecision actual = visibility::classifyObject(shared, view, i, {});
    const visibility::ObjectDecision wanted = visibility::classifyObject(expanded, view, i, {});
    EXPECT_EQ(std::memcmp(&actual, &wanted, sizeof actual), 0) << "object " << i;
  }
}

class SharedTransformsGl : public test::GlTest {};

TEST_F(SharedTransformsGl, KernelsAndPicturesEqualThoseOfTheExpandedScene) {
  const SceneData expanded = expandedScene();
  const SceneData shared = sharedScene(expanded);
  const scene::Camera camera = scene::lookAt({1, 2, 9}, {0, 0, 0}, expanded.boundsWorld);
  FrameRenderer actual(shared, kWidth, kHeight);
  FrameRenderer wanted(expanded, kWidth, kHeight);
  for (int frame = 0; frame < 2; ++frame) {  // the second frame has a history
    actual.render({}, camera, camera);
    wanted.render({}, camera, camera);
    expectSameFrame(actual, wanted);
  }
}

TEST_F(SharedTransformsGl, OneWriteMovesEveryObjectThatSharesTheTransform) {
  const SceneData expanded = expandedScene();
  const SceneData shared = sharedScene(expanded);
  const scene::Camera camera = scene::lookAt({1, 2, 9}, {0, 0, 0}, expanded.boundsWorld);
  FrameRenderer actual(shared, kWidth, kHeight);
  FrameRenderer wanted(expanded, kWidth, kHeight);
  const std::vector<gpu::Transform> moved = {
      scene::makeTransform(glm::scale(glm::translate(glm::mat4(1.0F), {0, 0, 4}), {1, 2, 1}))};
  const gpu::uint transform = shared.objects.front().transform;
  actual.setTransforms(transform, moved);
  std::size_t sharing = 0;
  for (std::size_t i = 0; i < shared.objects.size(); ++i) {
    if (shared.objects[i].transform != transform) continue;
    wanted.setTransforms(expanded.objects[i].transform, moved);
    ++sharing;
  }
  EXPECT_EQ(sharing, 2U);
  actual.render({}, camera, camera);
  wanted.render({}, camera, camera);
  expectSameFrame(actual, wanted);
}

}  // namespace
}  // namespace jalousie::render
