// The kernels that cull and count cells, against their CPU twins, on scenes with history, cross-fades and mirrored
// objects. A GPU may round the corners of a box differently: the kernel's decision is one that the twin makes with no
// guard, with the kernel's, or with twice the guard (see classify_gl_test.cpp).
#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/cell_reference.h"
#include "visibility/kernel_input.h"
#include "visibility/statistics_pass.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

constexpr ScreenSize kSize{333, 97};

SceneData dividedScene(std::uint32_t trianglesPerCell = 16) {
  return scene::buildScene(mixedFile(200), {.cells = {scene::CellOptions::Kind::kCount, trianglesPerCell}});
}

struct Decisions {
  std::vector<ObjectDecision> objects;
  std::vector<CellDecision> cells;
};

Decisions readDecisions(const ObjectStore& store) {
  Decisions result;
  const auto states = store.states.read<gpu::ObjectState>(store.objectCount);
  const auto marks = store.marks.read<gpu::uint>(store.objectCount);
  for (std::size_t i = 0; i < states.size(); ++i)
    result.objects.push_back({states[i], {}, marks[i]});
  const auto cellStates = store.cellStates.read<gpu::ObjectState>(store.cellCount);
  const auto cellMarks = store.cellMarks.read<gpu::uint>(store.cellCount);
  for (std::size_t i = 0; i < cellStates.size(); ++i)
    result.cells.push_back({cellStates[i], cellMarks[i]});
  return result;
}

class CellGl : public test::GlTest {
 protected:
  CellGl()
      : scene_(dividedScene()), buffers_(scene_), store_(buffers_.objectCount(), buffers_.cellCount()), pass_(store_) {}

  gpu::CullView viewOf(CullMode mode, const scene::Camera& camera) const {
    gpu::CullView view = makeView(scene_, camera, kSize, 1.0F, {.cullMode = mode, .lodRule = LodRule::kPixelError});
    view.cellCount = buffers_.cellCount();
    view.cullCells = 1;
    view.calm = 1;
    view.relax = 64.0F;
    view.occluderTau = mode == CullMode::kHomDepth ? 0.5F : 0.0F;
    return view;
  }

  /// Marks of a last frame: random phases, tests and cross-fades.
  void writeHistory(Random& random) {
    std::vector<gpu::uint> marks(buffers_.objectCount());
    std::vector<gpu::ObjectState> states(buffers_.objectCount());
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const gpu::uint levels = scene_.chains[scene_.objects[i].chain].lodCount;
      const gpu::uint lod = random.below(levels);
      states[i] = {gpu::kVerdictPartial, lod, 1, -1.0F};
      marks[i] = random.below(8) | random.below(2) * gpu::kMarkTested | random.below(2) * gpu::kMarkCalm;
      if (lod == 0 || random.below(2) == 0) continue;
      marks[i] |= (2 + random.below(6)) << gpu::kMarkFadeShift;
    }
    store_.states.write(0, std::as_bytes(std::span(states)));
    store_.marks.write(0, std::as_bytes(std::span(marks)));
    lastMarks_.resize(buffers_.cellCount());
    for (gpu::uint& mark : lastMarks_)
      mark = random.below(2) * gpu::kMarkTested | random.below(2) * gpu::kMarkVisible;
    store_.cellMarks.write(0, std::as_bytes(std::span(lastMarks_)));
  }

  /// @param twin  decides one cell with a given rounding
  template <class Twin>
  void expectPlausible(const Decisions& actual, const Twin& twin) {
    std::size_t exact = 0;
    for (gpu::uint c = 0; c < actual.cells.size(); ++c) {
      bool found = false;
      for (const float guards : {1.0F, 0.0F, 2.0F}) {
        const CellDecision expected = twin(c, guards * gpu::kRounding);
        found = found || actual.cells[c].marks == expected.marks;
        exact += guards == 1.0F && found ? 1 : 0;
        ASSERT_EQ(actual.cells[c].state.lod, expected.state.lod) << "cell " << c;
        ASSERT_EQ(actual.cells[c].state.verdict, expected.state.verdict) << "cell " << c;
      }
      ASSERT_TRUE(found) << "cell " << c << " marks " << actual.cells[c].marks << ", expected "
                         << twin(c, gpu::kRounding).marks;
    }
    EXPECT_GT(exact, actual.cells.size() * 99 / 100);
  }

  SceneData scene_;
  render::SceneBuffers buffers_;
  ObjectStore store_;
  VisibilityPass pass_;
  std::vector<gpu::uint> lastMarks_;
};

TEST_F(CellGl, ClassifyEqualsTheTwinInEveryMode) {
  Random random(5);
  std::size_t early = 0;
  std::size_t phaseless = 0;
  for (const CullModeRow& mode : cullModeTable()) {
    for (const glm::vec3 eye : {glm::vec3(0, 0, 9), glm::vec3(1, 0.5F, 0), glm::vec3(3, 2, 3)}) {
      for (const gpu::uint cullCells : {1U, 0U}) {
        SCOPED_TRACE(mode.name);
        writeHistory(random);
        gpu::CullView view = viewOf(mode.id, scene::lookAt(eye, {0.5F, 0, -0.5F}, scene_.boundsWorld));
        view.cullCells = cullCells;
        pass_.setView(view);
        pass_.classify(buffers_.bindings());
        const Decisions actual = readDecisions(store_);
        expectPlausible(actual, [&](gpu::uint c, float rounding) {
          return classifyCell({scene_, view, c, actual.objects[scene_.cells.objects[c].object], rounding},
                              lastMarks_[c]);
        });
        for (const CellDecision& cell : actual.cells) {
          early += (cell.marks & gpu::kMarkEarly) != 0 ? 1 : 0;
          phaseless += (cell.marks & (gpu::kMarkEarly | gpu::kMarkLate | gpu::kMarkTested)) == 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(early, 1000U);
  EXPECT_GT(phaseless, 1000U);
}

TEST_F(CellGl, AnalyseEqualsTheTwinOnEveryCover) {
  const scene::Camera camera = scene::lookAt({1, 0.5F, 5}, {0, 0, 0}, scene_.boundsWorld);
  Random random(6);
  for (const CullModeRow& mode : cullModeTable()) {
    if (!mode.testsOcclusion) continue;
    std::size_t culled = 0;
    std::size_t late = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(testing::Message() << mode.name << ' ' << seed);
      const GivenMap map(kSize, structuredPixels(kSize, seed));
      const GivenDepth depth(kSize, structuredDepth(kSize, seed),
                             mode.twoPhases ? DepthSource::kAll : DepthSource::kCovered, true);
      const Cover cover{mode.usesMap ? &map.reference : nullptr, mode.usesDepth ? &depth.reference : nullptr};
      writeHistory(random);
      const gpu::CullView view = viewOf(mode.id, camera);
      pass_.setView(view);
      pass_.classify(buffers_.bindings());
      const Decisions before = readDecisions(store_);
      pass_.analyse(buffers_.bindings(), view.traits, {&map.pass.texture(), &depth.pass.texture(), &depth.texture});
      const Decisions actual = readDecisions(store_);
      expectPlausible(actual, [&](gpu::uint c, float rounding) {
        CellDecision decided = before.cells[c];
        analyseCell({scene_, view, c, actual.objects[scene_.cells.objects[c].object], rounding}, cover,
                    mode.usesMap && mode.usesDepth ? 1.0F : 0.0F, decided);
        return decided;
      });
      for (std::size_t c = 0; c < actual.cells.size(); ++c) {
        const gpu::uint object = actual.objects[scene_.cells.objects[c].object].marks;
        const gpu::uint marks = actual.cells[c].marks;
        culled += (object & gpu::kMarkVisible) != 0 && (marks & gpu::kMarkVisible) == 0 ? 1 : 0;
        late += (marks & gpu::kMarkLate) != 0 ? 1 : 0;
      }
    }
    EXPECT_GT(late, 100U) << mode.name;
    EXPECT_GT(culled, 100U) << mode.name;
  }
}

TEST_F(CellGl, CountsOfCellsEqualTheTwin) {
  const scene::Camera camera = scene::lookAt({1, 0.5F, 5}, {0, 0, 0}, scene_.boundsWorld);
  Random random(7);
  DrawListPass lists(scene_);
  for (const std::uint32_t capacity : {2 * buffers_.cellCount(), 500U}) {
    const DrawListOptions options{Submission::kInstanced, capacity, false};
    DrawList early(scene_, gpu::kMarkEarly, options);
    DrawList late(scene_, gpu::kMarkLate, options);
    StatisticsPass statistics;
    writeHistory(random);
    const gpu::CullView view = viewOf(CullMode::kHiz, camera);
    pass_.setView(view);
    pass_.classify(buffers_.bindings());
    std::vector<gpu::uint> marks = store_.cellMarks.read<gpu::uint>(store_.cellCount);
    for (gpu::uint& mark : marks)  // as if half of what waits for the test had passed it
      if ((mark & gpu::kMarkEarly) == 0 && random.below(2) == 0) mark |= gpu::kMarkLate;
    store_.cellMarks.write(0, std::as_bytes(std::span(marks)));
    const auto states = store_.cellStates.read<gpu::ObjectState>(store_.cellCount);
    const auto objectStates = store_.states.read<gpu::ObjectState>(store_.objectCount);
    auto objectMarks = store_.marks.read<gpu::uint>(store_.objectCount);
    lists.build(early, buffers_.bindings(), pass_.decided());
    lists.build(late, buffers_.bindings(), pass_.decided());
    statistics.endFrame(buffers_.bindings(), pass_.decided(), view, &early, late);
    const std::vector<gpu::ScreenBox> boxes(states.size());
    const DrawLists first = buildDrawLists(scene_.drawn(), view, {states, boxes, marks}, gpu::kMarkEarly, options);
    const DrawLists second = buildDrawLists(scene_.drawn(), view, {states, boxes, marks}, gpu::kMarkLate, options);
    EXPECT_EQ(early.instances().read<gpu::uint>(first.instances.size()), first.instances);
    EXPECT_EQ(late.instances().read<gpu::uint>(second.instances.size()), second.instances);
    FrameCounters expected = countCells(scene_, view, {states, marks, {first.placed, second.placed}}, objectMarks);
    const FrameCounters ofObjects = countStates(scene_, view, objectStates, objectMarks);
    for (std::size_t k = 0; k < expected.size(); ++k)
      expected[k] += ofObjects[k];
    const auto& record = statistics.finish();
    ASSERT_TRUE(record.has_value());
    EXPECT_EQ(record->counters, expected);
    EXPECT_EQ(expected[gpu::kCounterDropped] > 0, capacity == 500U);
    EXPECT_GT(expected[gpu::kCounterCells], 100U);
    EXPECT_GT(expected[gpu::kCounterFading], 0U);
  }
}

}  // namespace
}  // namespace jalousie::visibility
