// Verdicts by shadows over random towns: none is wrong by lines of sight, and the traversal agrees with the flat test.
#include "culling/occluder_culling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "culling/random_solids.h"
#include "scene/camera.h"

namespace jalousie::culling {
namespace {

constexpr glm::uvec2 kScreen(640, 360);

/// Houses of one to three boxes, and people.
struct Town {
  scene::SceneData scene;
  std::vector<Aabb> boundsWorld;
};

std::uint32_t addChain(scene::SceneData& scene, const Aabb& box) {
  gpu::Chain chain{};
  chain.boundsMinObject = glm::vec4(box.min, 0.0F);
  chain.boundsMaxObject = glm::vec4(box.max, 0.0F);
  chain.lodCount = 1;
  scene.chains.push_back(chain);
  return static_cast<std::uint32_t>(scene.chains.size() - 1);
}

void addObject(Town& town, std::uint32_t chain, const glm::mat4& matrix) {
  scene::SceneData& scene = town.scene;
  const auto index = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({chain, index, index, index});
  scene.transforms.push_back(scene::makeTransform(matrix));
}

glm::mat4 placeOnGround(Random& random, float reach) {
  const glm::vec3 place(random.uniform(-reach, reach), 0.0F, random.uniform(-reach, reach));
  const glm::mat4 matrix = glm::rotate(glm::translate(glm::mat4(1.0F), place), random.uniform(-3.0F, 3.0F), {0, 1, 0});
  return glm::scale(matrix, {random.below(2) == 0 ? 1.0F : -1.0F, random.uniform(0.5F, 2.0F), 1.0F});
}

Town makeTown(std::uint64_t seed, std::uint32_t people = 600) {
  Random random(seed);
  Town town;
  const auto houses = 5 + random.below(40);
  for (std::uint32_t house = 0; house < houses; ++house) {
    Aabb bounds;
    std::vector<Aabb> boxes;
    for (std::uint32_t i = 0; i <= random.below(3); ++i) {
      const glm::vec3 half(random.uniform(1.0F, 6.0F), random.uniform(2.0F, 12.0F), random.uniform(1.0F, 6.0F));
      const glm::vec3 middle(random.uniform(-2.0F, 2.0F), half.y, random.uniform(-2.0F, 2.0F));
      boxes.push_back({middle - half, middle + half});
      bounds.add(boxes.back());
    }
    const std::uint32_t chain = addChain(town.scene, bounds);
    for (const Aabb& box : boxes)
      town.scene.occluders.push_back({solidOf(box), chain, random.below(8) != 0});
    addObject(town, chain, placeOnGround(random, 60.0F));
  }
  const std::uint32_t person = addChain(town.scene, {{-0.3F, 0.0F, -0.2F}, {0.3F, 1.8F, 0.2F}});
  for (std::uint32_t i = 0; i < people; ++i)
    addObject(town, person, placeOnGround(random, 80.0F));
  town.boundsWorld = worldBounds(town.scene.objects, town.scene.chains, town.scene.transforms);
  return town;
}

/// In the streets, above the roofs, and in houses.
QueryView randomView(Random& random) {
  const glm::vec3 eye(random.uniform(-70, 70), random.below(2) == 0 ? 1.7F : random.uniform(0.0F, 60.0F),
                      random.uniform(-70, 70));
  scene::Camera camera = scene::lookAt(eye, {random.uniform(-30, 30), random.uniform(-1, 5), random.uniform(-30, 30)},
                                       {glm::vec3(-80), glm::vec3(80)});
  camera.fovY = random.uniform(0.3F, 1.5F);
  if (random.below(5) == 0) {
    camera.halfSize = glm::vec2(random.uniform(5.0F, 40.0F));
    camera.zFar = 300.0F;
  }
  return makeQueryView(scene::clipFromWorld(camera, 640.0F / 360.0F), glm::vec4(eye, camera.zNear),
                       glm::vec4(camera.forwardWorld(), camera.isOrthographic() ? 1.0F : 0.0F),
                       scene::focalPixels(camera, kScreen), kScreen);
}

struct Verdicts {
  std::vector<bool> hidden;  ///< by object
  QueryFigures figures;
  std::vector<CastShadow> shadows;
};

Verdicts decide(const Town& town, const QueryView& view, const OccluderOptions& options,
                OccluderUse use = OccluderUse::kSolids, double outward = 0.0) {
  const OccluderTable table(town.scene, use);
  ActiveSet active(table.placed().size());
  const auto cast = active.cast(view, options, {table, town.scene.objects, town.scene.transforms, town.boundsWorld});
  Verdicts verdicts;
  verdicts.shadows.assign(cast.begin(), cast.end());
  for (CastShadow& shadow : verdicts.shadows)
    for (ShadowPlane& plane : shadow.planes)
      plane.offset += outward;
  const SpatialHierarchy tree = buildHierarchy(town.boundsWorld);
  OccluderCulling culling(tree.nodes.size(), tree.objects.size());
  const std::span<const std::uint32_t> bits = culling.cull(tree, view, verdicts.shadows, verdicts.figures);
  verdicts.hidden.resize(tree.objects.size());
  for (std::uint32_t place = 0; place < tree.objects.size(); ++place)
    verdicts.hidden[tree.objects[place]] = (bits[place / 32] >> place % 32 & 1U) == 0;
  return verdicts;
}

/// Points of the boxes of hidden objects that no house of the town is in front of, among some at random.
std::uint64_t wrongPoints(const Town& town, const QueryView& view, const Verdicts& verdicts, Random& random) {
  std::vector<glm::dmat4> objectFromWorld;
  for (const gpu::Transform& transform : town.scene.transforms)
    objectFromWorld.push_back(glm::inverse(matrixOf(transform)));
  std::uint64_t wrong = 0;
  for (std::size_t object = 0; object < verdicts.hidden.size(); ++object) {
    if (!verdicts.hidden[object]) continue;
    const Aabb& box = town.boundsWorld[object];
    for (int i = 0; i < 12; ++i) {
      const glm::dvec3 share(i & 1, i >> 1 & 1, i >> 2 & 1);
      const glm::dvec3 inner(random.uniform(), random.uniform(), random.uniform());
      const glm::dvec3 point = glm::mix(glm::dvec3(box.min), glm::dvec3(box.max), i < 8 ? share : inner);
      const glm::dvec3 eye =
          view.orthographic ? point - 1e3 * glm::dvec3(view.forwardWorld) : glm::dvec3(view.eyeWorld);
      const auto isBehind = [&](const scene::ChainOccluder& occluder) {
        const std::uint32_t house = occluder.chain;  // one for each chain
        if (house == object) return false;
        const auto toObject = [&](const glm::dvec3& p) {
          return glm::dvec3(objectFromWorld[house] * glm::dvec4(p, 1.0));
        };
        return meets(occluder.solid, toObject(eye), toObject(point), 1e-9);
      };
      const auto& all = town.scene.occluders;
      if (std::none_of(all.begin(), all.end(), isBehind)) ++wrong;
    }
  }
  return wrong;
}

std::size_t countHidden(const Verdicts& verdicts) {
  return static_cast<std::size_t>(std::count(verdicts.hidden.begin(), verdicts.hidden.end(), true));
}

TEST(OccluderCulling, NothingThatCanBeSeenIsHiddenInTwoHundredTowns) {
  Random random(11);
  std::size_t hidden[2] = {0, 0};
  std::uint64_t wrongIfLarger = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Town town = makeTown(seed);
    const QueryView view = randomView(random);
    for (const OccluderUse use : {OccluderUse::kSolids, OccluderUse::kPolygons}) {
      const Verdicts verdicts = decide(town, view, {.cap = seed % 4 == 0 ? Cap::kPaper : Cap::kExact}, use);
      EXPECT_EQ(wrongPoints(town, view, verdicts, random), 0U) << "town " << seed;
      hidden[static_cast<std::size_t>(use)] += countHidden(verdicts);
    }
    wrongIfLarger += wrongPoints(town, view, decide(town, view, {}, OccluderUse::kSolids, 1.0), random);
  }
  EXPECT_GT(hidden[0], 5000U);
  EXPECT_GT(hidden[0], hidden[1]) << "solids hide more than their faces";
  EXPECT_GT(hidden[1], 1000U);
  EXPECT_GT(wrongIfLarger, 0U) << "the lines of sight find planes that are off";
}

TEST(OccluderCulling, TheTraversalAgreesWithTheFlatTest) {
  Random random(12);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Town town = makeTown(seed);
    const QueryView view = randomView(random);
    const Verdicts verdicts = decide(town, view, {});
    for (std::size_t object = 0; object < town.boundsWorld.size(); ++object) {
      if (!view.frustum.holdsPartOf(town.boundsWorld[object])) continue;
      ASSERT_EQ(verdicts.hidden[object], isShaded(view, verdicts.shadows, town.boundsWorld[object])) << object;
    }
  }
}

TEST(OccluderCulling, TheLargestAreChosenWhateverTheOrderOfBounds) {
  Random random(13);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Town town = makeTown(seed);
    const QueryView view = randomView(random);
    const OccluderTable table(town.scene, OccluderUse::kSolids);
    std::vector<double> measures;
    std::uint32_t usable = 0;
    for (const PlacedOccluder& placed : table.placed()) {
      WorldOccluder occluder;
      occluder.place(table.shapeOf(placed), matrixOf(town.scene.transforms[placed.object]));
      const bool inView = view.frustum.holdsPartOf(occluder.boundsWorld());
      if (!inView || !table.holdsForEveryLevel(placed) || view.reachesNear(town.boundsWorld[placed.object])) continue;
      measures.push_back(solidAngle(occluder, viewpointOf(view)));
      usable += measures.back() > 0.0 ? 1 : 0;
    }
    std::sort(measures.rbegin(), measures.rend());
    const Verdicts verdicts = decide(town, view, {.active = 6});
    EXPECT_LE(verdicts.shadows.size(), 6U);
    if (verdicts.shadows.size() < 6 || usable < 6) continue;
    for (const CastShadow& shadow : verdicts.shadows) {
      const PlacedOccluder& placed = table.placed()[shadow.occluder];
      WorldOccluder occluder;
      occluder.place(table.shapeOf(placed), matrixOf(town.scene.transforms[placed.object]));
      // Spheres may reach into a view that boxes do not reach: such an occluder can only be an additional one.
      EXPECT_GE(solidAngle(occluder, viewpointOf(view)), measures[5] * (1.0 - 1e-9));
      EXPECT_TRUE(table.holdsForEveryLevel(placed));
    }
  }
}

TEST(OccluderCulling, MoreShadowsHideMoreAndAChoiceMayBeOld) {
  Random random(14);
  std::size_t few = 0;
  std::size_t many = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Town town = makeTown(seed);
    const QueryView view = randomView(random);
    few += countHidden(decide(town, view, {.active = 3}));
    many += countHidden(decide(town, view, {.active = 32}));
    EXPECT_EQ(countHidden(decide(town, view, {.active = 0})), 0U);
    // An old choice is used from another eye: fewer may be hidden, none wrongly.
    const OccluderTable table(town.scene, OccluderUse::kSolids);
    ActiveSet active(table.placed().size());
    const OccluderScene scene{table, town.scene.objects, town.scene.transforms, town.boundsWorld};
    const OccluderOptions options{.rankEvery = 10};
    active.cast(view, options, scene);
    const QueryView later = randomView(random);
    const auto shadows = active.cast(later, options, scene);
    Verdicts verdicts;
    for (const Aabb& box : town.boundsWorld)
      verdicts.hidden.push_back(isShaded(later, shadows, box));
    EXPECT_EQ(wrongPoints(town, later, verdicts, random), 0U) << "town " << seed;
  }
  EXPECT_GT(many, few);
}

TEST(OccluderCulling, TheHierarchySavesTests) {
  const Town town = makeTown(3, 20000);
  Random random(15);
  std::uint64_t planeTests = 0;
  std::uint64_t flat = 0;
  for (int i = 0; i < 20; ++i) {
    const QueryView view = randomView(random);
    const Verdicts verdicts = decide(town, view, {});
    planeTests += verdicts.figures.planeTests;
    for (const Aabb& box : town.boundsWorld) {
      flat += view.frustum.test(box).tested;
      if (!view.frustum.holdsPartOf(box)) continue;
      for (const CastShadow& shadow : verdicts.shadows)
        if (shadedBy(shadow.planes, box, flat) == Shaded::kFully) break;
    }
  }
  EXPECT_LT(4 * planeTests, flat);
}

}  // namespace
}  // namespace jalousie::culling
