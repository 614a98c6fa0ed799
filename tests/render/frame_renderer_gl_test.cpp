// Whole frames: every option permutation, repeatability, agreement with the CPU twins, figures against the driver's
// counts.
#include "render/frame_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>

#include "gl/buffer.h"
#include "render/make_statistics.h"
#include "support/gl_test.h"
#include "support/stages.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/draw_lists_reference.h"
#include "visibility/importance_mask.h"
#include "visibility/occlusion_map_pass.h"
#include "visibility/overlap_reference.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;

/// The thesis' pipeline.
FrameOptions homOptions() {
  FrameOptions options;
  options.cullMode = CullMode::kHom;
  options.lodRule = LodRule::kLinear;
  options.lvMeasure = LvMeasure::kThesis;
  options.occluderDistance = test::kWallOccluderDistance;
  return options;
}

std::size_t distinctColors(const ImageRgba8& image) {
  std::set<std::uint32_t> colors;
  for (std::size_t p = 0; p < image.pixels.size(); p += 4)
    colors.insert(image.pixels[p] | image.pixels[p + 1] << 8 | image.pixels[p + 2] << 16);
  return colors.size();
}

/// Colours that a view has at least: shading makes many, lines over one level's colour some (37 with --lod coverage), a
/// map or a count of surfaces few.
std::size_t leastColors(View view) {
  if (view == View::kOcclusion || view == View::kOverdraw || view == View::kDensity) return 2;
  return view == View::kWireframe ? 25 : 50;
}

/// Triangles the driver generated between begin and end.
class PrimitiveQuery {
 public:
  PrimitiveQuery() {
    glGenQueries(1, &id_);
    glBeginQuery(GL_PRIMITIVES_GENERATED, id_);
  }
  ~PrimitiveQuery() { glDeleteQueries(1, &id_); }
  PrimitiveQuery(const PrimitiveQuery&) = delete;
  PrimitiveQuery& operator=(const PrimitiveQuery&) = delete;
  std::uint64_t end() {
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint64 count = 0;
    glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &count);
    return count;
  }

 private:
  GLuint id_ = 0;
};

class FrameRendererGl : public test::GlTest {
 protected:
  scene::SceneData wallScene(float openShare, bool patches = false) {
    return scene::buildScene(test::spheresBehindWall(openShare), {.patches = patches});
  }
};

TEST_F(FrameRendererGl, EveryOptionPermutationDrawsAPictureWithACleanLog) {
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const scene::SceneData scene = wallScene(0.3F, detail == Detail::kTessellation);
    FrameRenderer renderer(scene, kWidth, kHeight);
    const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
    for (const CullModeRow& mode : cullModeTable()) {
      for (const LodRuleRow& rule : lodRuleTable()) {
        for (const ViewRow& view : viewTable()) {
          const bool needsTest = rule.followsLv || view.showsLv || view.needsOcclusionTest;
          if (needsTest && !mode.testsOcclusion) continue;
          if (view.needsTwoPhases && !mode.twoPhases) continue;
          FrameOptions options = homOptions();
          options.cullMode = mode.id;
          options.lodRule = rule.id;
          options.detail = detail;
          options.view = view.id;
          options.maxTessellation = 4;
          renderer.render(options, camera, camera);
          const std::size_t colors = distinctColors(renderer.readImage());
          EXPECT_GE(colors, leastColors(view.id))
              << rowOf(detail).name << ", mode " << mode.name << ", rule " << rule.name << ", view " << view.name;
        }
      }
    }
  }
}

TEST_F(FrameRendererGl, FramesRepeatBitForBit) {
  const scene::SceneData scene = wallScene(0.3F);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  FrameRenderer first(scene, kWidth, kHeight);
  first.render(homOptions(), camera, camera);
  const ImageRgba8 image = first.readImage();
  FrameOptions other = homOptions();
  other.view = View::kLv;
  first.render(other, camera, camera);
  first.render(homOptions(), camera, camera);
  EXPECT_EQ(first.readImage().pixels, image.pixels) << "the same renderer, later";
  FrameRenderer second(scene, kWidth, kHeight);
  second.render(homOptions(), camera, camera);
  EXPECT_EQ(second.readImage().pixels, image.pixels) << "another renderer";
}

TEST_F(FrameRendererGl, FrustumCullingChangesNoPixel) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 6.0F, 2));
  FrameRenderer renderer(scene, 333, 97);
  for (const glm::vec3 eye : {glm::vec3(0, 0, 14), glm::vec3(2, 1, 0)}) {
    const scene::Camera camera = scene::lookAt(eye, {0, 0.3F, -2}, scene.boundsWorld);
    FrameOptions options;
    options.lodRule = LodRule::kFinest;
    options.cullMode = CullMode::kFull;
    renderer.render(options, camera, camera);
    const ImageRgba8 full = renderer.readImage();
    options.cullMode = CullMode::kFrustum;
    renderer.render(options, camera, camera);
    EXPECT_EQ(renderer.readImage().pixels, full.pixels);
    EXPECT_GT(renderer.readStatistics().culledFrustum, 0U);
  }
}

TEST_F(FrameRendererGl, ClosedWallHidesEverySphereAndNoPixelChanges) {
  const scene::SceneData scene = wallScene(0.0F);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 0, 2.5F}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options = homOptions();
  options.occluderDistance = 3.0F;
  options.cullMode = CullMode::kFull;
  options.lodRule = LodRule::kFinest;
  renderer.render(options, camera, camera);
  const ImageRgba8 full = renderer.readImage();
  options.cullMode = CullMode::kHom;
  renderer.render(options, camera, camera);
  EXPECT_EQ(renderer.readImage().pixels, full.pixels);
  const FrameStatistics s = renderer.readStatistics();
  EXPECT_EQ(s.occluders, 1U);
  EXPECT_EQ(s.drawn, 1U);
  EXPECT_EQ(s.culledFrustum + s.culledOcclusion, 45U);
}

TEST_F(FrameRendererGl, DetailFallsAsTheWallCloses) {
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  for (const float openShare : {0.9F, 0.5F, 0.2F, 0.05F}) {
    const scene::SceneData scene = wallScene(openShare);
    FrameRenderer renderer(scene, kWidth, kHeight);
    const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
    renderer.render(homOptions(), camera, camera);
    const FrameStatistics s = renderer.readStatistics();
    const std::uint64_t spheres = s.triangles - scene.lods[scene.chains[1].firstLod].triangleCount;
    EXPECT_LT(spheres, last) << "open share " << openShare;
    last = spheres;
  }
}

TEST_F(FrameRendererGl, WholeFrameAgreesWithTheTwins) {
  const scene::SceneData scene = wallScene(0.25F);
  FrameRenderer renderer(scene, 333, 197);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  renderer.render(homOptions(), camera, camera);
  const visibility::OcclusionMapReference map(renderer.map().layout(), renderer.map().readOpenPixels());
  const std::vector<gpu::ObjectState> states = renderer.readStates();
  const std::vector<gpu::ScreenBox> boxes = renderer.readBoxes();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].verdict < gpu::kVerdictOpen && states[i].verdict != gpu::kVerdictOccluded) continue;
    const visibility::OverlapResult expected = visibility::testOverlap({&map, nullptr}, boxes[i], 1.0F);
    EXPECT_EQ(states[i].verdict, expected.verdict) << i;
    EXPECT_NEAR(states[i].lv, expected.lv, 2e-5F) << i;
    ++compared;
  }
  EXPECT_GT(compared, 30U);
}

TEST_F(FrameRendererGl, OccludersArePaintedByTheMapAndNothingElse) {
  const scene::SceneData scene = wallScene(0.5F);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  FrameOptions options = homOptions();
  options.occluderDistance = 0.0F;  // no occluders: the map stays open everywhere
  renderer.render(options, camera, camera);
  for (const float open : renderer.map().readOpenPixels())
    ASSERT_EQ(open, 1.0F);
  const FrameStatistics s = renderer.readStatistics();
  EXPECT_EQ(s.occluders, 0U);
  EXPECT_EQ(s.culledOcclusion, 0U);
  EXPECT_EQ(s.lodHistogram[0], s.drawn);
}

TEST_F(FrameRendererGl, FrozenCullingCameraKeepsVerdictsWhileTheViewMoves) {
  const scene::SceneData scene = wallScene(0.2F);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera front = test::cameraBeforeWall(scene.boundsWorld);
  const scene::Camera side = scene::lookAt({9, 3, -9}, {0, 0, -4}, scene.boundsWorld);
  renderer.render(homOptions(), front, front);
  const FrameStatistics before = renderer.readStatistics();
  const ImageRgba8 frontImage = renderer.readImage();
  renderer.render(homOptions(), front, side);
  EXPECT_EQ(renderer.readStatistics().triangles, before.triangles);
  EXPECT_EQ(renderer.readStatistics().lodHistogram, before.lodHistogram);
  EXPECT_NE(renderer.readImage().pixels, frontImage.pixels);
}

TEST_F(FrameRendererGl, TriangleCountEqualsTheDriversCount) {
  asset::SceneFile file = test::randomSpheres(60, 6.0F, 12);
  const scene::Camera camera = scene::lookAt({0, 0, 14}, {0, 0, 0}, {glm::vec3(-6), glm::vec3(6)});
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const scene::SceneData scene = scene::buildScene(file, {.patches = detail == Detail::kTessellation});
    FrameRenderer renderer(scene, 64, 64);
    FrameOptions options;
    options.detail = detail;
    options.cullMode = CullMode::kFrustum;
    options.lodRule = LodRule::kFinest;
    options.maxTessellation = 7;
    PrimitiveQuery query;
    renderer.render(options, camera, camera);
    EXPECT_EQ(query.end(), renderer.readStatistics().triangles) << "detail " << rowOf(detail).name;
  }
}

TEST_F(FrameRendererGl, EmptySceneShowsTheBackground) {
  const scene::SceneData scene = scene::buildScene(test::sphereChain(1));
  FrameRenderer renderer(scene, 33, 17);
  const scene::Camera camera = scene::frameBox(scene.boundsWorld, 1.0F);
  renderer.render({}, camera, camera);
  EXPECT_EQ(distinctColors(renderer.readImage()), 1U);
  EXPECT_EQ(renderer.readStatistics().drawn, 0U);
}

TEST_F(FrameRendererGl, SkippingTheDrawKeepsTheFigures) {
  const scene::SceneData scene = wallScene(0.3F);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  renderer.render(homOptions(), camera, camera);
  const FrameStatistics drawn = renderer.readStatistics();
  FrameOptions options = homOptions();
  options.skipDraw = true;
  renderer.render(options, camera, camera);
  EXPECT_EQ(renderer.readStatistics().triangles, drawn.triangles);
}

TEST_F(FrameRendererGl, PassesAreTimedByName) {
  const scene::SceneData scene = wallScene(0.3F);
  FrameRenderer renderer(scene, 64, 64);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  renderer.setTiming(Timing::kWall);
  renderer.render(homOptions(), camera, camera);
  std::vector<std::string> names;
  for (const PassTime& pass : renderer.passTimes())
    names.emplace_back(pass.name);
  EXPECT_EQ(names, (std::vector<std::string>{"classify", "early list", "occluders", "reduce map", "analyse",
                                             "late list", "draw", "count"}));
}

TEST_F(FrameRendererGl, TwoPhasePassesAreTimedByName) {
  const scene::SceneData scene = wallScene(0.3F);
  FrameRenderer renderer(scene, 64, 64);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  renderer.setTiming(Timing::kWall);
  renderer.render({}, camera, camera);
  std::vector<std::string> names;
  for (const PassTime& pass : renderer.passTimes())
    names.emplace_back(pass.name);
  EXPECT_EQ(names, (std::vector<std::string>{"classify", "early list", "early draw", "depth pyramid", "analyse",
                                             "late list", "late draw", "count pixels", "count"}));
}

TEST_F(FrameRendererGl, SubmissionsAndFastPathsGiveTheSameImageAndDepth) {
  asset::SceneFile file = test::randomSpheres(400, 6.0F, 21);
  file.materials.push_back(file.materials.front());
  file.materials.back().alphaMode = asset::AlphaMode::kBlend;
  file.materials.back().baseColor.a = 0.6F;
  file.meshes.push_back({"glass", {test::box(glm::vec3(1.0F), 1)}});
  file.chains.push_back({"glass", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::size_t i = 0; i < file.instances.size(); i += 7)
    file.instances[i].chain = 1;
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const scene::SceneData scene = scene::buildScene(file, {.patches = detail == Detail::kTessellation});
    const scene::Camera camera = scene::lookAt({0, 1, 13}, {0, 0, 0}, scene.boundsWorld);
    for (const CullMode mode : {CullMode::kHom, CullMode::kHiz}) {
      std::optional<ImageRgba8> image;
      std::vector<float> depth;
      for (const visibility::Submission submission :
           {visibility::Submission::kInstanced, visibility::Submission::kPerObject}) {
        for (const bool fastPaths : {false, true}) {
          FrameRenderer renderer(scene, 333, 197, {.submission = submission, .fastPaths = fastPaths});
          FrameOptions options;
          options.cullMode = mode;
          options.detail = detail;
          options.maxTessellation = 6;
          for (int frame = 0; frame < 3; ++frame)
            renderer.render(options, camera, camera);
          if (!image) {
            image = renderer.readImage();
            depth = renderer.readDepth();
          }
          EXPECT_EQ(renderer.readImage().pixels, image->pixels)
              << "detail " << rowOf(detail).name << " mode " << rowOf(mode).name;
          EXPECT_EQ(renderer.readDepth(), depth);
        }
      }
    }
  }
}

TEST_F(FrameRendererGl, StatisticsArriveTwoFramesLateWithoutWaiting) {
  const scene::SceneData scene = wallScene(0.3F);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  for (std::uint64_t frame = 1; frame <= 6; ++frame) {
    renderer.render({}, camera, camera);
    glFlush();
    const std::optional<FrameStatistics> statistics = renderer.latestStatistics();
    EXPECT_LE(statistics ? statistics->frame : 0, frame);
  }
  glFinish();
  ASSERT_TRUE(renderer.latestStatistics().has_value());
  EXPECT_EQ(renderer.latestStatistics()->frame, 6U);
  EXPECT_EQ(renderer.readStatistics().drawn, renderer.latestStatistics()->drawn);
}

TEST_F(FrameRendererGl, StatisticsEqualACountOfTheStates) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 6.0F, 14));
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 0, 12}, {0, 0, 0}, scene.boundsWorld);
  for (const CullModeRow& mode : cullModeTable()) {
    FrameOptions options;
    options.cullMode = mode.id;
    renderer.render(options, camera, camera);
    renderer.render(options, camera, camera);
    const FrameStatistics expected =
        makeStatistics(visibility::countStates(scene, renderer.cullView(), renderer.readStates(), renderer.readMarks()),
                       renderer.cullView(), countFinestTriangles(scene));
    const FrameStatistics actual = renderer.readStatistics();
    EXPECT_EQ(actual.drawn, expected.drawn);
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_EQ(actual.lodHistogram, expected.lodHistogram);
    EXPECT_EQ(actual.drawn + actual.culledFrustum + actual.culledOcclusion + actual.culledSmall, 300U);
  }
}

/// Figures of a frame by the CPU twins, lists with a capacity included.
FrameStatistics countWithLists(const scene::SceneData& scene, const FrameRenderer& renderer,
                               const visibility::DrawListOptions& lists) {
  const gpu::CullView view = renderer.cullView();
  const auto states = renderer.readStates();
  const auto boxes = renderer.readBoxes();
  const auto marks = renderer.readMarks();
  const visibility::ObjectDecisions decisions{states, boxes, marks};
  const visibility::DrawLists early = visibility::buildDrawLists(scene, view, decisions, gpu::kMarkEarly, lists);
  const visibility::DrawLists late = visibility::buildDrawLists(scene, view, decisions, gpu::kMarkLate, lists);
  return makeStatistics(visibility::countStates(scene, view, states, marks, {early.placed, late.placed}), view,
                        countFinestTriangles(scene));
}

TEST_F(FrameRendererGl, ListsThatRunOutDropCountAndReport) {
  constexpr std::uint32_t kCapacity = 20;
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 6.0F, 14));
  const scene::Camera camera = scene::lookAt({0, 0, 30}, {0, 0, 0}, scene.boundsWorld);
  for (const CullModeRow& mode : cullModeTable()) {
    for (const visibility::Submission submission :
         {visibility::Submission::kInstanced, visibility::Submission::kPerObject}) {
      SCOPED_TRACE(mode.name);
      FrameRenderer renderer(scene, kWidth, kHeight, {.submission = submission, .capacity = kCapacity});
      FrameOptions options;
      options.cullMode = mode.id;
      renderer.render(options, camera, camera);
      renderer.render(options, camera, camera);
      const FrameStatistics actual = renderer.readStatistics();
      const FrameStatistics expected = countWithLists(scene, renderer, {submission, kCapacity, false});
      EXPECT_EQ(actual.drawn, expected.drawn);
      EXPECT_EQ(actual.drawnEarly, expected.drawnEarly);
      EXPECT_EQ(actual.dropped, expected.dropped);
      EXPECT_EQ(actual.triangles, expected.triangles);
      EXPECT_EQ(actual.lodHistogram, expected.lodHistogram);
      EXPECT_LE(actual.drawn, 2 * kCapacity);
      EXPECT_GT(actual.dropped, 100U);
      EXPECT_EQ(actual.drawn + actual.dropped + actual.culledFrustum + actual.culledOcclusion + actual.culledSmall,
                300U);
      renderer.renderIds();
      const std::vector<std::uint32_t> ids = renderer.readIds();
      std::set<std::uint32_t> shown(ids.begin(), ids.end());
      shown.erase(0);
      EXPECT_GT(shown.size(), kCapacity / 2);
      EXPECT_LE(shown.size(), actual.drawn);
    }
  }
}

TEST_F(FrameRendererGl, PixelErrorSpendsLessWithALargerTau) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(200, 6.0F, 5));
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 0, 20}, {0, 0, 0}, scene.boundsWorld);
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  for (const float tau : {0.0F, 0.05F, 0.2F, 1.0F}) {
    FrameOptions options;
    options.lodRule = LodRule::kPixelError;
    options.cullMode = CullMode::kFrustum;
    options.tau = tau;
    renderer.render(options, camera, camera);
    const std::uint64_t triangles = renderer.readStatistics().triangles;
    EXPECT_LT(triangles, last) << "tau " << tau;
    last = triangles;
  }
}

TEST_F(FrameRendererGl, PixelErrorChoosesTessellationPerObject) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(200, 6.0F, 5), {.patches = true});
  FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 0, 14}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options;
  options.lodRule = LodRule::kPixelError;
  options.detail = Detail::kTessellation;
  options.cullMode = CullMode::kFrustum;
  options.tau = 0.25F;
  renderer.render(options, camera, camera);
  const FrameStatistics s = renderer.readStatistics();
  EXPECT_GE(std::count_if(s.lodHistogram.begin(), s.lodHistogram.end(), [](std::uint64_t n) { return n > 0; }), 3);
  EXPECT_LT(s.triangles, s.trianglesFinest / 4);
}

TEST_F(FrameRendererGl, ContributionAndImportanceLowerTheBudgetWhereAsked) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(300, 6.0F, 5));
  const scene::Camera camera = scene::lookAt({0, 0, 20}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options;
  options.lodRule = LodRule::kPixelError;
  options.cullMode = CullMode::kFrustum;
  options.tau = 0.1F;
  // Left half black, right half white.
  ImageRgba8 half{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  const visibility::ImportanceMask mask(half);
  FrameRenderer plain(scene, kWidth, kHeight);
  FrameRenderer masked(scene, kWidth, kHeight, {.importance = &mask});
  plain.render(options, camera, camera);
  masked.render(options, camera, camera);
  const auto before = plain.readStates();
  const auto after = masked.readStates();
  const auto boxes = plain.readBoxes();
  std::size_t coarser = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (boxes[i].maxX < kWidth / 2.0F) coarser += after[i].lod > before[i].lod ? 1 : 0;
    if (boxes[i].minX > kWidth / 2.0F) {
      EXPECT_EQ(after[i].lod, before[i].lod);
    }
    EXPECT_GE(after[i].lod, before[i].lod);
  }
  EXPECT_GT(coarser, 30U);
  options.minPixels = 200.0F;
  plain.render(options, camera, camera);
  EXPECT_GT(plain.readStatistics().culledSmall, 10U);
  EXPECT_LT(plain.readStatistics().culledSmall, 300U);
}

/// Compares verdicts, levels of visibility and lists of a settled two-phase frame with the twins.
void expectSettledFrameAgrees(const scene::SceneData& scene, const scene::Camera& camera, std::uint32_t width,
                              std::uint32_t height) {
  FrameRenderer renderer(scene, width, height);
  FrameOptions options;
  options.view = View::kLv;  // LV of every object
  options.lodRule = LodRule::kPixelError;
  options.lvMeasure = LvMeasure::kThesis;
  for (int frame = 0; frame < 4; ++frame)
    renderer.render(options, camera, camera);
  // Nothing is drawn late any more, so the final depth is what the pyramid was made of; blended surfaces come later.
  ASSERT_EQ(renderer.readStatistics().drawn, renderer.readStatistics().drawnEarly);
  ASSERT_FALSE(scene.usesBlending);
  const visibility::DepthPyramidReference pyramid(renderer.pyramid().layout(), renderer.readDepth(), false);
  const std::vector<gpu::ObjectState> states = renderer.readStates();
  const std::vector<gpu::ScreenBox> boxes = renderer.readBoxes();
  const std::vector<gpu::uint> marks = renderer.readMarks();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].verdict < gpu::kVerdictOpen && states[i].verdict != gpu::kVerdictOccluded) continue;
    const visibility::OverlapResult expected = visibility::testOverlap({nullptr, &pyramid}, boxes[i], 1.0F);
    EXPECT_EQ(states[i].verdict, expected.verdict) << i;
    EXPECT_NEAR(states[i].lv, expected.lv, 2e-5F) << i;
    ++compared;
  }
  EXPECT_GT(compared, 20U);
  const visibility::DrawLists expected =
      visibility::buildDrawLists(scene, renderer.cullView(), {states, boxes, marks}, gpu::kMarkEarly,
                                 {.capacity = static_cast<std::uint32_t>(states.size())});
  EXPECT_EQ(renderer.earlyList().instances().read<gpu::uint>(expected.instances.size()), expected.instances);
}

TEST_F(FrameRendererGl, SettledTwoPhaseFrameAgreesWithTheTwins) {
  const scene::SceneData scene = wallScene(0.25F);
  expectSettledFrameAgrees(scene, test::cameraBeforeWall(scene.boundsWorld), 333, 197);
}

TEST_F(FrameRendererGl, RealScenesAgreeWithTheTwins) {
  const char* folder = std::getenv("JALOUSIE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the two game scenes";
  for (const char* name : {"candela_city", "cornfield_crossing"}) {
    scene::SceneData scene =
        scene::buildScene(asset::readSceneFile(std::filesystem::path(folder) / name / "scene.gltf"));
    for (gpu::Lod& lod : scene.lods)
      lod.blendCount = 0;  // drawn after the pyramid: leave them out so that the final depth is the pyramid's
    scene.usesBlending = false;
    expectSettledFrameAgrees(scene, scene::lookAt({0, 8, 0}, {-40, 4, -20}, scene.boundsWorld), 640, 360);
    expectSettledFrameAgrees(scene, scene::frameBox(scene.boundsWorld, 1.0F), 333, 97);
  }
}

}  // namespace
}  // namespace jalousie::render
