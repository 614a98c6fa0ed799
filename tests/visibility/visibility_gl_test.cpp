// Each kernel against its plain CPU twin, on seeded random and adversarial input.
#include "visibility/visibility_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"
#include "visibility/commands_reference.h"
#include "visibility/overlap_reference.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

struct ScreenSize {
  std::uint32_t width, height;
};
constexpr ScreenSize kSizes[] = {{640, 360}, {1366, 77}, {333, 97}, {64, 64}, {1, 1}, {1, 200}};

gpu::CullView makeView(const SceneData& scene, const scene::Camera& camera, ScreenSize size, float occluderDistance) {
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, static_cast<float>(size.width) / static_cast<float>(size.height));
  view.cameraWorld = glm::vec4(camera.positionWorld(), 1.0F);
  view.viewportWidth = size.width;
  view.viewportHeight = size.height;
  view.objectCount = static_cast<gpu::uint>(scene.objects.size());
  view.cullMode = gpu::kCullHom;
  view.lodRule = gpu::kLodLinear;
  view.detail = gpu::kDetailDiscrete;
  view.analyse = 1;
  view.mapLevels = mapLayout(size.width, size.height).levels;
  view.occluderDistance = occluderDistance;
  view.cullThreshold = 1.0F;
  view.maxTessellation = gpu::kMaxTessellationLevel;
  return view;
}

Aabb boundsOf(const SceneData& scene, std::size_t object) {
  const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
  return {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)};
}

/// Verdicts that rounding could explain: those of slightly smaller and larger boxes and distances.
std::vector<gpu::uint> plausibleVerdicts(const SceneData& scene, std::size_t object, const gpu::CullView& view) {
  std::vector<gpu::uint> verdicts;
  for (const float change : {-1e-5F, 0.0F, 1e-5F}) {
    Aabb box = boundsOf(scene, object);
    const glm::vec3 margin = change * box.extent();
    box = {box.min - margin, box.max + margin};
    gpu::CullView changed = view;
    changed.occluderDistance *= 1.0F - change;
    verdicts.push_back(classify(boxOnScreen(scene::worldFromObject(scene.objects[object]), box, view.clipFromWorld,
                                            glm::vec2(view.viewportWidth, view.viewportHeight)),
                                changed));
  }
  return verdicts;
}

void expectSameRect(const gpu::ScreenRect& gpuRect, const gpu::ScreenRect& cpuRect, float tolerance) {
  EXPECT_NEAR(gpuRect.minX, cpuRect.minX, tolerance);
  EXPECT_NEAR(gpuRect.minY, cpuRect.minY, tolerance);
  EXPECT_NEAR(gpuRect.maxX, cpuRect.maxX, tolerance);
  EXPECT_NEAR(gpuRect.maxY, cpuRect.maxY, tolerance);
}

/// Runs the classify kernel and compares every verdict and rectangle with the twin.
void compareClassification(const SceneData& scene, const gpu::CullView& view) {
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(buffers.objectCount());
  pass.setView(view);
  pass.classify(buffers.bindings());
  const auto states = pass.states().read<gpu::ObjectState>(scene.objects.size());
  const auto rects = pass.rects().read<gpu::ScreenRect>(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::vector<gpu::uint> plausible = plausibleVerdicts(scene, i, view);
    EXPECT_NE(std::find(plausible.begin(), plausible.end(), states[i].verdict), plausible.end())
        << "object " << i << " verdict " << states[i].verdict << " expected " << plausible[1];
    if (states[i].verdict != plausible[1]) continue;
    const BoxOnScreen box = boxOnScreen(scene::worldFromObject(scene.objects[i]), boundsOf(scene, i),
                                        view.clipFromWorld, glm::vec2(view.viewportWidth, view.viewportHeight));
    if (box.outside || box.crossesNear) continue;
    expectSameRect(rects[i], box.rect, 0.02F);
  }
}

class ClassifyGl : public test::GlTest {};

TEST_F(ClassifyGl, RandomScenesFromOutsideAndInside) {
  const SceneData scene = scene::buildScene(test::randomSpheres(500, 10.0F, 1));
  for (const glm::vec3 eye : {glm::vec3(0, 0, 40), glm::vec3(3, 2, 1), glm::vec3(-12, 9, 0)})
    for (const ScreenSize size : kSizes)
      compareClassification(scene, makeView(scene, scene::lookAt(eye, {0, 0.5F, 0}, scene.boundsWorld), size, 15.0F));
}

TEST_F(ClassifyGl, AdversarialBoxes) {
  asset::SceneFile file = test::sphereChain(2);
  const glm::vec3 eye(0, 0, 5);
  test::addInstance(file, 0, {0, 0, 5}, glm::vec3(1));          // the eye is inside
  test::addInstance(file, 0, {0, 0, 4.9F}, glm::vec3(0.2F));    // across the near plane
  test::addInstance(file, 0, {0, 0, 6}, glm::vec3(0.5F));       // behind
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1e-6F));      // smaller than a pixel
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(0.0F));       // a point
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1e6F));       // larger than the screen
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1, 0, 1));    // flat
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(-2, 1, -1));  // mirrored twice
  test::addInstance(file, 0, {1e5F, 0, -1e5F}, glm::vec3(1));   // far away
  const SceneData scene = scene::buildScene(file);
  for (const ScreenSize size : kSizes)
    compareClassification(scene,
                          makeView(scene, scene::lookAt(eye, {0, 0, 0}, {glm::vec3(-1), glm::vec3(1)}), size, 3.0F));
}

TEST_F(ClassifyGl, EmptySceneAndSingleObject) {
  asset::SceneFile file = test::sphereChain(1);
  const SceneData empty = scene::buildScene(file);
  compareClassification(empty, makeView(empty, scene::lookAt({0, 0, 5}, {0, 0, 0}, {}), {64, 64}, 1.0F));
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const SceneData one = scene::buildScene(file);
  compareClassification(one, makeView(one, scene::lookAt({0, 0, 5}, {0, 0, 0}, one.boundsWorld), {64, 64}, 1.0F));
}

/// A map whose level 0 is given instead of drawn.
struct GivenMap {
  GivenMap(ScreenSize size, const std::vector<float>& openPixels)
      : pass(mapLayout(size.width, size.height)), reference(pass.layout(), openPixels) {
    pass.beginOccluders();
    glTextureSubImage2D(pass.texture().id(), 0, 0, 0, static_cast<GLsizei>(size.width),
                        static_cast<GLsizei>(size.height), GL_RED, GL_FLOAT, openPixels.data());
    pass.reduce();
  }
  OcclusionMapPass pass;
  OcclusionMapReference reference;
};

/// Random cover with structure at several scales: pixels, stripes and blocks.
std::vector<float> structuredPixels(ScreenSize size, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> pixels(std::size_t{size.width} * size.height);
  const std::uint32_t cell = 1U << random.below(5);
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const std::uint32_t tile = (x / cell) * 7919U + (y / cell) * 104729U + static_cast<std::uint32_t>(seed);
      pixels[std::size_t{y} * size.width + x] = tile % 5 < 2 || random.below(50) == 0 ? 1.0F : 0.0F;
    }
  }
  return pixels;
}

class OcclusionMapGl : public test::GlTest {};

TEST_F(OcclusionMapGl, ReductionEqualsTheTwinBitForBitAtAnySize) {
  for (const ScreenSize size : kSizes) {
    const GivenMap map(size, structuredPixels(size, size.width));
    for (std::uint32_t level = 0; level < map.pass.layout().levels; ++level) {
      const std::span<const float> expected = map.reference.level(level);
      std::vector<float> actual(expected.size());
      glGetTextureImage(map.pass.texture().id(), static_cast<GLint>(level), GL_RED, GL_FLOAT,
                        static_cast<GLsizei>(actual.size() * sizeof(float)), actual.data());
      EXPECT_TRUE(std::equal(actual.begin(), actual.end(), expected.begin()))
          << size.width << "x" << size.height << " level " << level;
    }
  }
}

/// Rectangles of every kind: tiny, huge, at the borders, degenerate, aligned and misaligned.
std::vector<gpu::ScreenRect> adversarialRects(ScreenSize size, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  std::vector<gpu::ScreenRect> rects = {{0, 0, width, height},    {0, 0, 0, 0},         {width, height, width, height},
                                        {0.5F, 0.5F, 0.6F, 0.6F}, {0, 0, width, 0.25F}, {0, 0, 0.25F, height}};
  while (rects.size() < count) {
    const float scale = std::exp2(-random.uniform(0.0F, 9.0F));
    float x0 = random.uniform(0.0F, width);
    float y0 = random.uniform(0.0F, height);
    if (random.below(3) == 0) x0 = std::floor(x0 / 16.0F) * 16.0F;
    if (random.below(3) == 0) y0 = std::floor(y0);
    rects.push_back({x0, y0, std::min(width, x0 + random.uniform() * scale * width),
                     std::min(height, y0 + random.uniform() * scale * height)});
  }
  return rects;
}

SceneData sceneOfCount(std::size_t count) {
  asset::SceneFile file = test::sphereChain(5);
  for (std::size_t i = 0; i < count; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  return scene::buildScene(file);
}

class AnalyseGl : public test::GlTest {};

TEST_F(AnalyseGl, VerdictsEqualTheTwinAndLevelsOfVisibilityAreClose) {
  constexpr std::size_t kCount = 1500;
  const SceneData scene = sceneOfCount(kCount);
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(buffers.objectCount());
  std::size_t verdicts[gpu::kVerdictCount] = {};
  for (const ScreenSize size : kSizes) {
    for (const float threshold : {1.0F, 0.9F}) {
      const GivenMap map(size, structuredPixels(size, 7 + size.height));
      const std::vector<gpu::ScreenRect> rects = adversarialRects(size, kCount, size.width);
      gpu::CullView view = makeView(scene, {}, size, 0.0F);
      view.cullThreshold = threshold;
      pass.setView(view);
      pass.rectsForTest().write(0, std::as_bytes(std::span(rects)));
      const std::vector<gpu::ObjectState> pending(kCount, {gpu::kVerdictPending, 0, 20, -1.0F});
      pass.statesForTest().write(0, std::as_bytes(std::span(pending)));
      pass.analyse(buffers.bindings(), map.pass);
      const auto states = pass.states().read<gpu::ObjectState>(kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        const OverlapResult expected = testOverlap(map.reference, rects[i], threshold);
        ASSERT_EQ(states[i].verdict, expected.verdict) << size.width << "x" << size.height << " rect " << i;
        ASSERT_NEAR(states[i].lv, expected.lv, 2e-5F) << size.width << "x" << size.height << " rect " << i;
        ++verdicts[states[i].verdict];
      }
    }
  }
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, DecidedObjectsAreLeftAlone) {
  const SceneData scene = sceneOfCount(4);
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(buffers.objectCount());
  const ScreenSize size{64, 64};
  const GivenMap map(size, std::vector<float>(64 * 64, 0.0F));
  pass.setView(makeView(scene, {}, size, 0.0F));
  const std::vector<gpu::ObjectState> decided = {{gpu::kVerdictOutside, 0, 20, -1.0F},
                                                 {gpu::kVerdictOccluder, 0, 20, -1.0F},
                                                 {gpu::kVerdictNear, 0, 20, -1.0F},
                                                 {gpu::kVerdictOpen, 0, 20, -1.0F}};
  pass.statesForTest().write(0, std::as_bytes(std::span(decided)));
  pass.analyse(buffers.bindings(), map.pass);
  const auto states = pass.states().read<gpu::ObjectState>(4);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(states[i].verdict, decided[i].verdict);
}

class EmitGl : public test::GlTest {};

bool sameCommand(const gpu::DrawCommand& a, const gpu::DrawCommand& b) {
  return a.count == b.count && a.instanceCount == b.instanceCount && a.firstIndex == b.firstIndex &&
         a.baseVertex == b.baseVertex && a.baseInstance == b.baseInstance;
}

/// Spheres, some mirrored, half of them with a second, double-sided chain.
asset::SceneFile mixedFile() {
  asset::SceneFile file = test::randomSpheres(200, 5.0F, 3);
  file.materials.push_back(file.materials.front());
  file.materials.back().doubleSided = true;
  asset::Primitive sheet = test::box(glm::vec3(1.0F), 1);
  file.meshes.push_back({"box with both", {sheet, test::box(glm::vec3(0.5F), 0)}});
  file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::size_t i = 0; i < file.instances.size(); i += 2)
    file.instances[i].chain = 1;
  return file;
}

TEST_F(EmitGl, CommandsEqualTheTwinOnBothDetailPaths) {
  for (const bool patches : {false, true}) {
    const SceneData scene = scene::buildScene(mixedFile(), {.patches = patches});
    const auto count = static_cast<gpu::uint>(scene.objects.size());
    const render::SceneBuffers buffers(scene);
    VisibilityPass pass(count);
    gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F);
    view.detail = patches ? gpu::kDetailTessellation : gpu::kDetailDiscrete;
    for (const gpu::uint rule : {gpu::kLodFinest, gpu::kLodLinear}) {
      view.lodRule = rule;
      pass.setView(view);
      Random random(17);
      std::vector<gpu::ObjectState> input(count);
      for (gpu::ObjectState& state : input)
        state = {random.below(gpu::kVerdictCount), 0, view.maxTessellation, random.uniform(-2.0F, 1.0F)};
      input[0] = {gpu::kVerdictPartial, 0, view.maxTessellation, 1.0F};  // level 1: the plain program
      pass.statesForTest().write(0, std::as_bytes(std::span(input)));
      pass.emitCommands(buffers.bindings());
      const auto states = pass.states().read<gpu::ObjectState>(count);
      const auto commands = pass.commands().read<gpu::DrawCommand>(std::size_t{gpu::kListCount} * count);
      const gpu::uint lists = patches ? gpu::kListCount : gpu::kListSolidPatch;
      for (gpu::uint i = 0; i < count; ++i) {
        const gpu::ObjectState expected = chooseDetail(input[i], view, scene.chains[scene.objects[i].chain]);
        ASSERT_EQ(states[i].lod, expected.lod) << i;
        ASSERT_EQ(states[i].tessellation, expected.tessellation) << i;
        const auto wanted =
            objectCommands(scene, view, i, isDrawn(expected.verdict), expected.lod, expected.tessellation);
        for (gpu::uint list = 0; list < lists; ++list)
          ASSERT_TRUE(sameCommand(commands[std::size_t{list} * count + i], wanted[list]))
              << "object " << i << " list " << list;
      }
    }
  }
}

TEST_F(EmitGl, OccluderPassDrawsExactlyTheOccluders) {
  const SceneData scene = scene::buildScene(test::randomSpheres(300, 10.0F, 8));
  const auto count = static_cast<gpu::uint>(scene.objects.size());
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(count);
  const gpu::CullView view =
      makeView(scene, scene::lookAt({0, 0, 25}, {0, 0, 0}, scene.boundsWorld), {320, 200}, 18.0F);
  pass.setView(view);
  pass.classify(buffers.bindings());
  const auto states = pass.states().read<gpu::ObjectState>(count);
  const auto commands = pass.commands().read<gpu::DrawCommand>(std::size_t{2} * count);
  std::size_t occluders = 0;
  for (gpu::uint i = 0; i < count; ++i) {
    const bool occluder = states[i].verdict == gpu::kVerdictOccluder;
    occluders += occluder ? 1 : 0;
    const auto wanted = objectCommands(scene, view, i, occluder, 0, view.maxTessellation);
    for (gpu::uint list = 0; list < 2; ++list)
      ASSERT_TRUE(sameCommand(commands[std::size_t{list} * count + i], wanted[list])) << "object " << i;
  }
  EXPECT_GT(occluders, 10U);
  EXPECT_LT(occluders, count);
}

}  // namespace
}  // namespace jalousie::visibility
