// The pictures of the mode that sees rooms through portals against those without culling.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"
#include "support/building.h"

namespace jalousie::render {
namespace {

/// A view from a place in the building; one in four stands in the frame of a door, one in eight outside.
scene::Camera randomCamera(const test::Building& building, const Aabb& boundsWorld, Random& random) {
  const std::uint32_t kind = random.below(8);
  const bool inFrame = kind < 2 && !building.plan().portals.empty();
  glm::vec3 eye(inFrame ? building.randomPlaceInPortal(random) : building.randomPlace(random, 0.02));
  if (kind == 7) eye.x -= 20.0F;
  const glm::vec3 direction(random.uniform(-1, 1), random.uniform(-0.4F, 0.4F), random.uniform(-1, 1));
  scene::Camera camera = scene::lookAt(eye, eye + direction, boundsWorld);
  camera.fovY = random.uniform(0.4F, 1.5F);
  camera.zNear = 0.02F;
  return camera;
}

/// Through a building from room to room, three frames at a place.
test::Journey walkThrough(const test::Building& building, std::uint64_t seed, bool moves) {
  test::Journey journey{"building", scene::buildScene(building.file()), {}, {}};
  const Aabb boundsWorld = journey.scene.boundsWorld;
  journey.camera = [building, boundsWorld, seed](std::uint32_t frame) {
    Random random(1000 * seed + frame / 3);
    return randomCamera(building, boundsWorld, random);
  };
  if (moves) {
    // The spheres, and not the walls: portals do not move with them.
    const auto move = test::swingObjects(journey.scene, 3);
    std::vector<bool> isWall(journey.scene.transforms.size());
    for (const gpu::Object& object : journey.scene.objects)
      isWall[object.transform] = object.chain != 0;
    journey.move = [move, isWall](std::uint32_t frame, std::span<gpu::Transform> transforms) {
      const std::vector<gpu::Transform> before(transforms.begin(), transforms.end());
      move(frame, transforms);
      for (std::size_t i = 0; i < transforms.size(); ++i)
        if (isWall[i]) transforms[i] = before[i];
    };
  }
  return journey;
}

class PortalsGl : public MethodGl {
 protected:
  scene::Camera inside() const {
    Random random(3);
    const glm::vec3 eye(building_.randomPlace(random, 0.3));
    scene::Camera camera = scene::lookAt(eye, {6, eye.y, 6}, scene_.boundsWorld);
    camera.zNear = 0.02F;
    return camera;
  }

  const test::Building building_{4};
  const scene::SceneData rooms_ = scene::buildScene(building_.file());
  const scene::Camera inside_ = inside();
};

TEST_F(PortalsGl, NoPixelAndNoDepthIsLost) {
  std::uint64_t culled = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const test::Building building(seed, {.blocks = 3 + static_cast<std::uint32_t>(seed % 3)});
    const test::Journey journey = walkThrough(building, seed, seed % 2 == 1);
    FrameOptions frameOptions = options(CullMode::kPortals);
    if (seed % 3 == 0) frameOptions.lodRule = LodRule::kFinest;
    const test::CullingLoss loss = test::countLoss(journey, kOddWidth, kOddHeight, frameOptions, 0, 30);
    EXPECT_EQ(loss.wrongPixels, 0U) << "building " << seed;
    EXPECT_EQ(loss.differentDepths, 0U) << "building " << seed;
    culled += loss.culled;
  }
  EXPECT_GT(culled, 2000U);
}

TEST_F(PortalsGl, DirectNeighboursLosePixels) {
  std::uint64_t wrong = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    FrameOptions frameOptions = options(CullMode::kPortals);
    frameOptions.occluders.portalReach = culling::PortalReach::kNeighbours;
    wrong += test::countLoss(walkThrough(test::Building(seed), seed, false), kOddWidth, kOddHeight, frameOptions, 0, 24)
                 .wrongPixels;
  }
  EXPECT_GT(wrong, 0U);
}

TEST_F(PortalsGl, PortalsThatAreALittleTooSmallAreNoticed) {
  std::uint64_t wrong = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    wrong += test::countLoss(walkThrough(test::Building(seed, {.portalScale = 0.8F}), seed, false), kOddWidth,
                             kOddHeight, options(CullMode::kPortals), 0, 24)
                 .wrongPixels;
  EXPECT_GT(wrong, 0U);
}

TEST_F(PortalsGl, EveryLevelRuleGivesThePictureWithoutCulling) {
  for (const LodRuleRow& rule : lodRuleTable()) {
    if (rule.followsLv) continue;  // levels follow counted pixels, which start without a count
    FrameOptions frameOptions = options(CullMode::kPortals);
    frameOptions.lodRule = rule.id;
    const Frame frame = draw(rooms_, frameOptions, inside_);
    EXPECT_GT(frame.statistics.culledOcclusion, 0U) << rule.name;
    EXPECT_GT(frame.statistics.rooms, 0U) << rule.name;
    EXPECT_GT(frame.statistics.portals, 0U) << rule.name;
    frameOptions.cullMode = CullMode::kFull;
    EXPECT_EQ(frame.pixels, draw(rooms_, frameOptions, inside_).pixels) << rule.name;
  }
}

TEST_F(PortalsGl, DrawsAllOutsideAndWithoutRooms) {
  const scene::Camera outside = scene::lookAt({-9, 4, -9}, {6, 3, 6}, rooms_.boundsWorld);
  asset::SceneFile file = building_.file();
  file.rooms = {};
  for (const scene::Camera& camera : {outside, inside_}) {
    const Frame frame =
        draw(&camera == &outside ? rooms_ : scene::buildScene(file), options(CullMode::kPortals), outside);
    EXPECT_EQ(frame.statistics.culledOcclusion, 0U);
    EXPECT_EQ(frame.statistics.rooms, 0U);
  }
  EXPECT_EQ(draw(scene::buildScene(file), options(CullMode::kPortals), inside_).statistics.culledOcclusion, 0U);
}

TEST_F(PortalsGl, CurvedPatchesAndParallelViewsHideNothing) {
  const scene::SceneData patches = scene::buildScene(building_.file(), {.patches = true});
  FrameOptions frameOptions = options(CullMode::kPortals);
  frameOptions.detail = Detail::kTessellation;
  EXPECT_EQ(draw(patches, frameOptions, inside_).statistics.rooms, 0U);
  scene::Camera parallel = inside_;
  parallel.halfSize = glm::vec2(3.0F, 2.0F);
  parallel.zFar = 50.0F;
  const Frame frame = draw(rooms_, options(CullMode::kPortals), parallel);
  EXPECT_EQ(frame.statistics.rooms, 0U);
  EXPECT_EQ(frame.pixels, draw(rooms_, options(CullMode::kFull), parallel).pixels);
}

TEST_F(PortalsGl, AFrozenCullingCameraIsShownFromOutside) {
  const scene::Camera above = scene::lookAt({6, 30, 20}, {6, 0, 6}, rooms_.boundsWorld);
  const Frame usual = draw(rooms_, options(CullMode::kPortals), inside_);
  const Frame frozen = draw(rooms_, options(CullMode::kPortals), inside_, above);
  EXPECT_EQ(frozen.statistics.drawn, usual.statistics.drawn);
  EXPECT_NE(frozen.pixels, draw(rooms_, options(CullMode::kFrustum), inside_, above).pixels) << "objects are missing";
}

TEST_F(PortalsGl, TwoRunsGiveTheSameMarks) {
  FrameRenderer first(rooms_, kOddWidth, kOddHeight);
  FrameRenderer second(rooms_, kOddWidth, kOddHeight);
  for (FrameRenderer* renderer : {&first, &second})
    renderer->render(options(CullMode::kPortals), inside_, inside_);
  EXPECT_EQ(first.readMarks(), second.readMarks());
}

}  // namespace
}  // namespace jalousie::render
