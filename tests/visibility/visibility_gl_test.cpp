// Each kernel against its plain CPU twin, on seeded random and adversarial input.
#include "visibility/visibility_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "asset/scene_file.h"
#include "core/random.h"
#include "policy/frame_policy.h"
#include "render/scene_buffers.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/frame_counters.h"
#include "visibility/item_buffer.h"
#include "visibility/overlap_reference.h"
#include "visibility/statistics_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

struct ScreenSize {
  std::uint32_t width, height;
};
constexpr ScreenSize kSizes[] = {{640, 360}, {1366, 77}, {333, 97}, {64, 64}, {1, 1}, {1, 200}};

/// The mode of the thesis with its level rule, and no measure.
constexpr FramePolicy kThesisPolicy{
    .cullMode = CullMode::kHom, .lodRule = LodRule::kLinear, .lvMeasure = LvMeasure::kNone};

gpu::CullView makeView(const SceneData& scene, const scene::Camera& camera, ScreenSize size, float occluderDistance,
                       const FramePolicy& policy = kThesisPolicy) {
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, static_cast<float>(size.width) / static_cast<float>(size.height));
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.viewportWidth = size.width;
  view.viewportHeight = size.height;
  view.objectCount = static_cast<gpu::uint>(scene.objects.size());
  view.traits = traitsOf(policy);
  view.analyse = 1;
  view.mapLevels = mapLayout(size.width, size.height).levels;
  view.occluderDistance = occluderDistance;
  view.cullThreshold = 1.0F;
  view.maxTessellation = gpu::kMaxTessellationLevel;
  view.focalPixels = scene::focalPixels(camera, size.height);
  view.tau = 1.0F;
  view.hysteresis = gpu::kDefaultHysteresis;
  view.fadeFrames = gpu::kDefaultFadeFrames;
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
    verdicts.push_back(classify(boxOnScreen(scene.transforms[object], box, view.clipFromWorld,
                                            glm::vec2(view.viewportWidth, view.viewportHeight)),
                                changed));
  }
  return verdicts;
}

void expectSameBox(const gpu::ScreenBox& actual, const gpu::ScreenBox& expected) {
  constexpr float kPixels = 0.02F;
  EXPECT_NEAR(actual.minX, expected.minX, kPixels);
  EXPECT_NEAR(actual.minY, expected.minY, kPixels);
  EXPECT_NEAR(actual.maxX, expected.maxX, kPixels);
  EXPECT_NEAR(actual.maxY, expected.maxY, kPixels);
  EXPECT_NEAR(actual.nearestDepth, expected.nearestDepth, 1e-5F * expected.nearestDepth);
  EXPECT_NEAR(actual.pixelsPerUnit, expected.pixelsPerUnit, 1e-4F * expected.pixelsPerUnit);
  EXPECT_NEAR(actual.tau, expected.tau, 1e-4F * expected.tau);
}

/// Runs the classify kernel, on a history of visible and hidden objects, and compares everything it writes with the
/// twin.
void compareClassification(const SceneData& scene, const gpu::CullView& view,
                           const ImportanceMask* importance = nullptr, bool countsValid = true) {
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(buffers.objectCount(), importance);
  std::vector<LastFrame> last(scene.objects.size());
  Random random(31);
  for (std::size_t i = 0; i < last.size(); ++i) {
    const gpu::Chain& chain = scene.chains[scene.objects[i].chain];
    last[i].state = {gpu::kVerdictPartial, random.below(chain.lodCount), 1 + random.below(view.maxTessellation),
                     random.uniform(-1.5F, 1.0F)};
    constexpr gpu::uint kHistories[] = {0, gpu::kMarkTested, gpu::kMarkTested | gpu::kMarkVisible, gpu::kMarkVisible};
    last[i].marks = kHistories[random.below(4)];
    if (random.below(2) == 0) last[i].marks |= random.below(2) == 0 ? gpu::kMarkEarly : gpu::kMarkLate;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkCounted;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkCalm;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkMeasured;
    const gpu::uint frames = random.below(3) == 0 ? random.below(gpu::kDefaultFadeFrames + 1) : 0;
    const bool fromCoarser = last[i].state.lod == 0 || random.below(2) == 0;
    if (frames > 0) last[i].marks |= frames << gpu::kMarkFadeShift | (fromCoarser ? gpu::kMarkFromCoarser : 0);
    last[i].pixels = random.below(3) == 0 ? 0 : random.below(1U << random.below(16));
  }
  std::vector<gpu::ObjectState> lastStates;
  std::vector<gpu::uint> lastMarks;
  std::vector<gpu::uint> lastPixels;
  for (const LastFrame& frame : last) {
    lastStates.push_back(frame.state);
    lastMarks.push_back(frame.marks);
    lastPixels.push_back(frame.pixels);
  }
  pass.statesForTest().write(0, std::as_bytes(std::span(lastStates)));
  pass.marksForTest().write(0, std::as_bytes(std::span(lastMarks)));
  pass.pixelCountsForTest(countsValid).write(0, std::as_bytes(std::span(lastPixels)));
  gpu::CullView counted = view;
  counted.countsValid = countsValid ? 1 : 0;
  pass.setView(counted);
  pass.classify(buffers.bindings());
  const auto states = pass.states().read<gpu::ObjectState>(scene.objects.size());
  const auto boxes = pass.boxes().read<gpu::ScreenBox>(scene.objects.size());
  const auto marks = pass.marks().read<gpu::uint>(scene.objects.size());
  std::size_t otherLevels = 0;
  for (gpu::uint i = 0; i < scene.objects.size(); ++i) {
    const std::vector<gpu::uint> plausible = plausibleVerdicts(scene, i, view);
    const Classified expected = classifyObject(scene, counted, i, last[i], importance);
    if (view.minPixels == 0.0F) {
      EXPECT_NE(std::find(plausible.begin(), plausible.end(), states[i].verdict), plausible.end())
          << "object " << i << " verdict " << states[i].verdict << " expected " << plausible[1];
    }
    if (states[i].verdict != expected.state.verdict) continue;
    EXPECT_NEAR(states[i].lv, expected.state.lv, 1e-5F) << "object " << i;
    if (expected.state.verdict == gpu::kVerdictOutside || expected.state.verdict == gpu::kVerdictNear) continue;
    expectSameBox(boxes[i], expected.box);
    // A level is a threshold on a float: an ulp may decide, but only rarely.
    const bool sameLevels =
        states[i].lod == expected.state.lod && states[i].tessellation == expected.state.tessellation;
    otherLevels += sameLevels ? 0 : 1;
    if (sameLevels) {
      EXPECT_EQ(marks[i], expected.marks) << "object " << i;
    }
  }
  EXPECT_LE(otherLevels, 1 + scene.objects.size() / 200);
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

TEST_F(ClassifyGl, EveryModeAndRuleWithMaskAndThreshold) {
  ImageRgba8 image{37, 21, std::vector<std::uint8_t>(37 * 21 * 4)};
  Random random(77);
  for (std::uint8_t& byte : image.pixels)
    byte = static_cast<std::uint8_t>(random.below(6) == 0 ? 255 : random.below(60));
  const ImportanceMask mask(image);
  const SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 4), {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const CullModeRow& mode : cullModeTable()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F,
                                    {.cullMode = mode.id, .lodRule = rule.id, .lvMeasure = LvMeasure::kNone});
      view.relax = 8.0F;
      compareClassification(scene, view);
      view.minPixels = 60.0F;
      view.tau = 3.0F;
      compareClassification(scene, view, &mask);
    }
  }
}

TEST_F(ClassifyGl, EveryMeasureCalmAndNot) {
  const SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 9), {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHom, CullMode::kHiz}) {
    for (const LvMeasure measure : {LvMeasure::kChord, LvMeasure::kPixels}) {
      for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
        for (const gpu::uint calm : {0U, 1U}) {
          gpu::CullView view =
              makeView(scene, camera, {640, 360}, 20.0F,
                       {.cullMode = mode, .lodRule = LodRule::kLvError, .lvMeasure = measure, .detail = detail});
          view.relax = 64.0F;
          view.tau = 0.3F;
          view.calm = calm;
          compareClassification(scene, view);
          compareClassification(scene, view, nullptr, false);
          view.hysteresis = 1.3F;
          for (const gpu::uint frames : {0U, 3U, gpu::kMaxFadeFrames}) {
            view.fadeFrames = frames;
            compareClassification(scene, view);
          }
        }
      }
    }
  }
}

TEST_F(ClassifyGl, RealScenes) {
  const char* folder = std::getenv("JALOUSIE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the two game scenes";
  for (const char* name : {"candela_city", "cornfield_crossing"}) {
    const SceneData scene =
        scene::buildScene(asset::readSceneFile(std::filesystem::path(folder) / name / "scene.gltf"));
    for (const glm::vec3 eye : {glm::vec3(0, 8, 0), glm::vec3(0, 40, 60), glm::vec3(300, 200, 300)}) {
      compareClassification(scene, makeView(scene, scene::lookAt(eye, {-40, 4, -20}, scene.boundsWorld), {1366, 768},
                                            40.0F, {.lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone}));
    }
  }
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
      : pass(mapLayout(size.width, size.height), nullptr), reference(pass.layout(), openPixels) {
    pass.beginOccluders(false);
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

/// Depth with structure: a far wall, nearer cells, and holes.
std::vector<float> structuredDepth(ScreenSize size, std::uint64_t seed) {
  Random random(seed);
  const std::vector<float> open = structuredPixels(size, seed);
  std::vector<float> depth(open.size());
  for (std::size_t i = 0; i < depth.size(); ++i)
    depth[i] = open[i] > 0.0F ? (random.below(3) == 0 ? 0.0F : 0.1F) : random.uniform(0.4F, 0.6F);
  return depth;
}

/// A depth buffer with given content, and its pyramids.
struct GivenDepth {
  GivenDepth(ScreenSize size, const std::vector<float>& values, DepthSource source, bool fastPaths)
      : texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {size.width, size.height, 1, 1}, "given depth"),
        pass(mapLayout(size.width, size.height),
             fastPaths ? gl::queryCapabilities() : gl::queryCapabilities().withoutFastPaths()),
        reference(pass.layout(), values, source == DepthSource::kCovered) {
    glTextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height),
                        GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
    pass.build(texture, source);
  }
  gl::Texture texture;
  DepthPyramidPass pass;
  DepthPyramidReference reference;
};

class DepthPyramidGl : public test::GlTest {};

TEST_F(DepthPyramidGl, EqualsTheTwinBitForBitAtAnySizeWithAndWithoutTheMinFilter) {
  for (const ScreenSize size : kSizes) {
    for (const DepthSource source : {DepthSource::kAll, DepthSource::kCovered}) {
      for (const bool fastPaths : {false, true}) {
        const GivenDepth depth(size, structuredDepth(size, size.width + 5), source, fastPaths);
        for (std::uint32_t level = 1; level < depth.pass.layout().levels; ++level) {
          const std::span<const float> expected = depth.reference.level(level);
          const std::vector<float> actual = depth.pass.readLevel(level);
          EXPECT_TRUE(std::equal(actual.begin(), actual.end(), expected.begin(), expected.end()))
              << size.width << "x" << size.height << " level " << level << " fast " << fastPaths;
        }
      }
    }
  }
}

/// Boxes of every kind: tiny, huge, at the borders, degenerate, aligned and misaligned, at any depth.
std::vector<gpu::ScreenBox> adversarialBoxes(ScreenSize size, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  std::vector<glm::vec4> rects = {{0, 0, width, height},    {0, 0, 0, 0},         {width, height, width, height},
                                  {0.5F, 0.5F, 0.6F, 0.6F}, {0, 0, width, 0.25F}, {0, 0, 0.25F, height}};
  while (rects.size() < count) {
    const float scale = std::exp2(-random.uniform(0.0F, 9.0F));
    float x0 = random.uniform(0.0F, width);
    float y0 = random.uniform(0.0F, height);
    if (random.below(3) == 0) x0 = std::floor(x0 / 16.0F) * 16.0F;
    if (random.below(3) == 0) y0 = std::floor(y0);
    rects.emplace_back(x0, y0, std::min(width, x0 + random.uniform() * scale * width),
                       std::min(height, y0 + random.uniform() * scale * height));
  }
  std::vector<gpu::ScreenBox> boxes;
  for (const glm::vec4& rect : rects)
    boxes.push_back(
        {rect.x, rect.y, rect.z, rect.w, random.below(9) == 0 ? 0.1F : random.uniform(0.05F, 0.7F), 1.0F, 1.0F, 0});
  return boxes;
}

SceneData sceneOfCount(std::size_t count) {
  asset::SceneFile file = test::sphereChain(5);
  for (std::size_t i = 0; i < count; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  return scene::buildScene(file);
}

class AnalyseGl : public test::GlTest {
 protected:
  /// Runs the kernel of a mode on given boxes, some of them drawn early, and compares with the twin.
  static void compare(CullMode mode, std::size_t (&verdicts)[gpu::kVerdictCount],
                      LvMeasure measure = LvMeasure::kThesis, gpu::uint calm = 0) {
    constexpr std::size_t kCount = 1500;
    const SceneData scene = sceneOfCount(kCount);
    const render::SceneBuffers buffers(scene);
    VisibilityPass pass(buffers.objectCount());
    for (const ScreenSize size : kSizes) {
      for (const float threshold : {1.0F, 0.9F}) {
        const GivenMap map(size, structuredPixels(size, 7 + size.height));
        const GivenDepth depth(size, structuredDepth(size, 7 + size.height),
                               !rowOf(mode).usesMap ? DepthSource::kAll : DepthSource::kCovered, true);
        const Cover cover{!rowOf(mode).usesMap ? nullptr : &map.reference,
                          !rowOf(mode).usesDepth ? nullptr : &depth.reference};
        const std::vector<gpu::ScreenBox> boxes = adversarialBoxes(size, kCount, size.width);
        const LodRule rule = calm != 0 ? LodRule::kLvError : LodRule::kLinear;
        gpu::CullView view = makeView(scene, {}, size, 0.0F, {.cullMode = mode, .lodRule = rule, .lvMeasure = measure});
        view.cullThreshold = threshold;
        view.occluderTau = mode == CullMode::kHomDepth ? 0.5F : 0.0F;
        view.calm = calm;
        view.relax = 64.0F;
        pass.setView(view);
        std::vector<gpu::ObjectState> states(kCount, {gpu::kVerdictPending, 3, 20, -0.5F});
        std::vector<gpu::uint> marks(kCount);
        for (std::size_t i = 0; i < kCount; i += 3)
          marks[i] = !rowOf(mode).usesMap ? gpu::kMarkEarly | gpu::kMarkVisible : 0;
        for (std::size_t i = 0; i < kCount; i += 2)
          marks[i] |= calm != 0 ? gpu::kMarkCalm | gpu::kMarkRemembered : 0;
        for (std::size_t i = 0; i < kCount; i += 5)
          marks[i] |= gpu::kMarkKnown | (i % 3 == 0 && measure == LvMeasure::kPixels ? gpu::kMarkCounted : 0) |
                      (i % 2 == 0 ? 3U << gpu::kMarkFadeShift : 0);
        pass.boxesForTest().write(0, std::as_bytes(std::span(boxes)));
        pass.statesForTest().write(0, std::as_bytes(std::span(states)));
        pass.marksForTest().write(0, std::as_bytes(std::span(marks)));
        pass.analyse(buffers.bindings(), view.traits, {&map.pass, &depth.pass, &depth.texture});
        const auto gpuStates = pass.states().read<gpu::ObjectState>(kCount);
        const auto gpuMarks = pass.marks().read<gpu::uint>(kCount);
        for (std::size_t i = 0; i < kCount; ++i) {
          const OverlapResult result =
              testOverlap(cover, boxes[i], threshold, mode == CullMode::kHomDepth ? 1.0F : 0.0F,
                          (marks[i] & gpu::kMarkCounted) != 0 ? std::nullopt : std::optional(view.traits));
          applyOverlap(result, scene, view, scene.chains[0], boxes[i], states[i], marks[i]);
          ASSERT_EQ(gpuStates[i].verdict, states[i].verdict) << size.width << "x" << size.height << " box " << i;
          ASSERT_NEAR(gpuStates[i].lv, states[i].lv, measure == LvMeasure::kThesis ? 2e-5F : 2e-4F)
              << size.width << "x" << size.height << " box " << i << " measure " << rowOf(measure).name;
          ASSERT_EQ(gpuMarks[i], marks[i]) << size.width << "x" << size.height << " box " << i;
          ++verdicts[states[i].verdict];
        }
      }
    }
  }
};

TEST_F(AnalyseGl, MapEqualsTheTwin) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHom, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, MapWithDepthEqualsTheTwin) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHomDepth, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 20U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, DepthPyramidEqualsTheTwinAndTellsStaleFromOccluded) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHiz, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictStale], 50U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, EveryMeasureEqualsTheTwinOnEveryCover) {
  for (const CullMode mode : {CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz}) {
    for (const LvMeasureRow& measure : lvMeasureTable()) {
      std::size_t verdicts[gpu::kVerdictCount] = {};
      compare(mode, verdicts, measure.id);
      EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
      compare(mode, verdicts, measure.id, 1);
    }
  }
}

TEST_F(AnalyseGl, DecidedObjectsAreLeftAlone) {
  const SceneData scene = sceneOfCount(4);
  const render::SceneBuffers buffers(scene);
  VisibilityPass pass(buffers.objectCount());
  const ScreenSize size{64, 64};
  const GivenMap map(size, std::vector<float>(64 * 64, 0.0F));
  const gpu::CullView view = makeView(scene, {}, size, 0.0F);
  pass.setView(view);
  const std::vector<gpu::ObjectState> decided = {{gpu::kVerdictOutside, 0, 20, -1.0F},
                                                 {gpu::kVerdictOccluder, 0, 20, -1.0F},
                                                 {gpu::kVerdictNear, 0, 20, -1.0F},
                                                 {gpu::kVerdictOpen, 0, 20, -1.0F}};
  pass.statesForTest().write(0, std::as_bytes(std::span(decided)));
  pass.analyse(buffers.bindings(), view.traits, {&map.pass, nullptr, nullptr});
  const auto states = pass.states().read<gpu::ObjectState>(4);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(states[i].verdict, decided[i].verdict);
}

class ItemBufferGl : public test::GlTest {};

TEST_F(ItemBufferGl, CountsEqualTheTwin) {
  constexpr std::uint32_t kObjects = 500;
  VisibilityPass pass(kObjects);
  for (const ScreenSize size : {ScreenSize{1, 1}, {33, 5}, {640, 360}, {1366, 77}, {256, 16}, {257, 17}}) {
    for (const std::uint32_t cell : {0U, 1U, 3U, 40U}) {
      Random random(size.width + cell);
      gl::Texture items(GL_TEXTURE_2D, GL_R32UI, {size.width, size.height, 1, 1}, "items");
      items.setSampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
      std::vector<std::uint32_t> values(std::size_t{size.width} * size.height, kObjects);  // cell 0: one object
      const std::uint32_t salt = random.below(1000);
      for (std::uint32_t y = 0; y < size.height && cell > 0; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x)
          values[std::size_t{y} * size.width + x] =
              cell == 1 ? random.below(kObjects + 1) : ((x / cell) * 31 + (y / cell) * 17 + salt) % (kObjects + 1);
      glTextureSubImage2D(items.id(), 0, 0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height),
                          GL_RED_INTEGER, GL_UNSIGNED_INT, values.data());
      pass.countPixels(items);
      EXPECT_EQ(pass.pixelCounts().read<gpu::uint>(kObjects), countPixels(values, kObjects))
          << size.width << "x" << size.height << " cell " << cell;
    }
  }
}

bool sameCommand(const gpu::DrawCommand& a, const gpu::DrawCommand& b) {
  return a.count == b.count && a.instanceCount == b.instanceCount && a.firstIndex == b.firstIndex &&
         a.baseVertex == b.baseVertex && a.baseInstance == b.baseInstance;
}

/// Spheres, some mirrored; a third of the objects of a second chain with solid, double-sided and blended boxes.
asset::SceneFile mixedFile(std::uint32_t count) {
  asset::SceneFile file = test::randomSpheres(count, 5.0F, 3);
  file.materials.resize(3, file.materials.front());
  file.materials[1].doubleSided = true;
  file.materials[2].alphaMode = asset::AlphaMode::kBlend;
  file.meshes.push_back(
      {"box with all", {test::box(glm::vec3(1.0F), 1), test::box(glm::vec3(0.5F), 0), test::box(glm::vec3(1.2F), 2)}});
  file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::size_t i = 0; i < file.instances.size(); i += 3)
    file.instances[i].chain = 1;
  return file;
}

class DrawListGl : public test::GlTest {
 protected:
  struct Input {
    std::vector<gpu::ObjectState> states;
    std::vector<gpu::ScreenBox> boxes;
    std::vector<gpu::uint> marks;
  };

  /// Random states; mirrored marks come from the transforms.
  static Input randomInput(const SceneData& scene, gpu::uint maxTessellation, std::uint64_t seed) {
    Random random(seed);
    Input input;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const gpu::Chain& chain = scene.chains[scene.objects[i].chain];
      input.states.push_back({gpu::kVerdictPartial, random.below(chain.lodCount),
                              random.below(3) == 0 ? 1 : 1 + random.below(maxTessellation), -1.0F});
      input.boxes.push_back({0, 0, 1, 1, 0.5F, std::exp2(random.uniform(0.0F, 12.0F)), 1.0F, 0});
      input.marks.push_back(random.below(8) | (isMirrored(scene.transforms[i]) ? gpu::kMarkMirrored : 0));
      if (chain.lodCount == 1 || random.below(3) > 0) continue;
      const gpu::uint lod = input.states.back().lod;
      const bool fromCoarser = lod == 0 || (lod + 1 < chain.lodCount && random.below(2) == 0);
      input.marks.back() |= (1 + random.below(gpu::kDefaultFadeFrames)) << gpu::kMarkFadeShift |
                            (fromCoarser ? gpu::kMarkFromCoarser : 0);
    }
    return input;
  }

  /// Builds one list on the GPU and compares instances, commands and counts with the twin.
  static void compare(const SceneData& scene, const gpu::CullView& view, gpu::uint phase,
                      const DrawListOptions& options, const Input& input) {
    const render::SceneBuffers buffers(scene);
    VisibilityPass pass(buffers.objectCount());
    pass.setView(view);
    pass.statesForTest().write(0, std::as_bytes(std::span(input.states)));
    pass.boxesForTest().write(0, std::as_bytes(std::span(input.boxes)));
    pass.marksForTest().write(0, std::as_bytes(std::span(input.marks)));
    DrawListPass lists(scene);
    DrawList list(scene, phase, options);
    for (int repeat = 0; repeat < 2; ++repeat)  // the second run starts from the first one's leftovers
      lists.build(list, buffers.bindings(), pass);
    const DrawLists expected = buildDrawLists(scene, view, input.states, input.boxes, input.marks, phase,
                                              options.submission, options.capacity);
    const auto instances = list.instances().read<gpu::uint>(expected.instances.size());
    EXPECT_EQ(instances, expected.instances);
    const auto counts = list.drawCounts().read<gpu::uint>(gpu::kDrawCounts);
    EXPECT_EQ(counts[gpu::kCountInstances], expected.instances.size());
    EXPECT_EQ(counts[gpu::kCountDropped], expected.dropped);
    const gpu::uint kinds = options.patches ? gpu::kListCount : gpu::kListsPerDetail;
    const auto commands = list.commands().read<gpu::DrawCommand>(std::size_t{kinds} * list.commandCapacity());
    for (gpu::uint kind = 0; kind < kinds; ++kind) {
      std::vector<gpu::DrawCommand> wanted = expected.commands[kind];
      const bool perObject = options.submission == Submission::kPerObject;
      EXPECT_EQ(counts[kind], perObject ? expected.instances.size() : wanted.size()) << "list " << kind;
      wanted.resize(list.commandCapacity());  // the rest must draw nothing
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        const gpu::DrawCommand& actual = commands[std::size_t{kind} * list.commandCapacity() + i];
        if (wanted[i].instanceCount == 0) {
          ASSERT_EQ(actual.instanceCount, 0U) << "list " << kind << " command " << i;
        } else {
          ASSERT_TRUE(sameCommand(actual, wanted[i])) << "list " << kind << " command " << i;
        }
      }
    }
  }
};

TEST_F(DrawListGl, EqualsTheTwinOnBothDetailPathsAndSubmissions) {
  for (const bool patches : {false, true}) {
    const SceneData scene = scene::buildScene(mixedFile(700), {.patches = patches});
    for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
      if (detail == Detail::kTessellation && !patches) continue;
      for (const CullMode mode : {CullMode::kHomDepth, CullMode::kHiz}) {
        gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = mode, .detail = detail});
        view.occluderTau = 2.0F;
        const Input input = randomInput(scene, view.maxTessellation, 17 + static_cast<std::uint64_t>(mode));
        for (const gpu::uint phase : {gpu::kMarkEarly, gpu::kMarkLate})
          for (const Submission submission : {Submission::kInstanced, Submission::kPerObject})
            for (const std::uint32_t capacity : {1400U, 700U, 100U, 1U})
              compare(scene, view, phase, {submission, capacity, patches}, input);
      }
    }
  }
}

TEST_F(DrawListGl, EdgesOfTilesScansAndChains) {
  for (const std::uint32_t count : {0U, 1U, 63U, 64U, 65U, 129U}) {
    const SceneData scene = scene::buildScene(mixedFile(count));
    const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz});
    Input input = randomInput(scene, 20, count);
    compare(scene, view, gpu::kMarkLate, {Submission::kInstanced, count, false}, input);
    for (gpu::uint& mark : input.marks)
      mark = 0;  // nothing drawn
    compare(scene, view, gpu::kMarkLate, {Submission::kInstanced, count, false}, input);
    for (gpu::uint& mark : input.marks)
      mark = gpu::kMarkLate;  // everything
    compare(scene, view, gpu::kMarkLate, {Submission::kInstanced, count, false}, input);
  }
}

TEST_F(DrawListGl, ManyTilesNeedASecondPrefixSum) {
  const SceneData scene = scene::buildScene(mixedFile(40000));
  EXPECT_GT(scene.binLayout.entryCount, 2 * gpu::kScanBlock);
  const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz});
  compare(scene, view, gpu::kMarkEarly, {Submission::kInstanced, 40000, false}, randomInput(scene, 20, 5));
}

TEST_F(DrawListGl, ManyChainsNeedSeveralRoundsOfCommands) {
  asset::SceneFile file = test::sphereChain(4);
  for (std::uint32_t c = 1; c < 150; ++c)
    file.chains.push_back({"copy", file.chains[0].levels});
  for (std::uint32_t i = 0; i < 3000; ++i)
    test::addInstance(file, (i * 7919U) % 150, {0, 0, 0}, {i % 5 == 0 ? -1.0F : 1.0F, 1, 1});
  const SceneData scene = scene::buildScene(file);
  EXPECT_GT(scene.binLayout.bins.size(), 4 * gpu::kScanGroupSize);
  const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz});
  compare(scene, view, gpu::kMarkLate, {Submission::kInstanced, 3000, false}, randomInput(scene, 20, 6));
}

class CountGl : public test::GlTest {};

TEST_F(CountGl, FiguresEqualTheTwinAndArriveThroughTheRing) {
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const SceneData scene = scene::buildScene(mixedFile(1000), {.patches = true});
    const render::SceneBuffers buffers(scene);
    VisibilityPass pass(buffers.objectCount());
    DrawListPass lists(scene);
    DrawList list(scene, gpu::kMarkLate, {Submission::kInstanced, 1000, true});
    StatisticsPass ring;
    EXPECT_FALSE(ring.latest().has_value());
    const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz, .detail = detail});
    pass.setView(view);
    Random random(3);
    std::vector<gpu::ObjectState> states;
    std::vector<gpu::uint> marks;
    for (std::uint64_t frame = 1; frame <= 7; ++frame) {
      states.clear();
      marks.clear();
      for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        states.push_back({random.below(gpu::kVerdictCount), random.below(scene.chains[scene.objects[i].chain].lodCount),
                          1 + random.below(20), -1.0F});
        marks.push_back(random.below(16));
      }
      pass.statesForTest().write(0, std::as_bytes(std::span(states)));
      pass.marksForTest().write(0, std::as_bytes(std::span(marks)));
      lists.build(list, buffers.bindings(), pass);
      ring.endFrame(buffers.bindings(), pass, view, nullptr, list);
    }
    const auto& record = ring.finish();
    ASSERT_TRUE(record.has_value());
    EXPECT_EQ(record->frame, 7U);
    EXPECT_EQ(record->counters, countStates(scene, view, states, marks));
    EXPECT_GT(triangleSum(record->counters), 1000U);
  }
}

}  // namespace
}  // namespace jalousie::visibility
