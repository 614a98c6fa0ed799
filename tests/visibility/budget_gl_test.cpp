// The kernels that keep a frame within a budget of triangles, against their CPU twins, on random decisions with history
// and cross-fades.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "policy/traits.h"
#include "render/scene_buffers.h"
#include "support/gl_test.h"
#include "visibility/budget_pass.h"
#include "visibility/frame_counters.h"
#include "visibility/kernel_input.h"
#include "visibility/price_control.h"
#include "visibility/triangle_budget.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

constexpr ScreenSize kSize{640, 360};

/// What a frame has decided before its levels become coarser.
struct Input {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
  std::vector<gpu::uint> marks;
  std::vector<gpu::uint> cellMarks;
};

Input randomInput(const scene::SceneData& scene, Random& random) {
  Input input;
  for (const gpu::Object& object : scene.objects) {
    const gpu::uint levels = scene.chains[object.chain].lodCount;
    const gpu::uint lod = random.below(levels);
    input.states.push_back({gpu::kVerdictPartial, lod, 1 + random.below(20), random.uniform(-1.0F, 1.0F)});
    const float side = random.below(5) == 0 ? 0.0F : std::exp(random.uniform(0.0F, 5.0F));
    input.boxes.push_back({10.0F, 20.0F, 10.0F + side, 20.0F + side, 0.5F, std::exp(random.uniform(0.0F, 5.0F)),
                           random.uniform(0.5F, 2.0F), gpu::kCoverOpen});
    gpu::uint mark = random.below(8) | random.below(2) * gpu::kMarkKnown | random.below(2) * gpu::kMarkCounted |
                     random.below(2) * gpu::kMarkUnseen | random.below(4) / 3 * gpu::kMarkNew |
                     random.below(2) * gpu::kMarkRemembered;
    if (lod > 0 && random.below(3) == 0) mark |= (1 + random.below(8)) << gpu::kMarkFadeShift;
    input.marks.push_back(mark);
  }
  for (const gpu::Object& cell : scene.cells.objects)
    input.cellMarks.push_back((input.marks[cell.object] & gpu::kMarkPhases) != 0 ? random.below(8) : 0);
  return input;
}

/// Passes, buffers and lists of one scene.
struct Machine {
  explicit Machine(const scene::SceneData& sceneData)
      : scene(sceneData),
        buffers(scene),
        store(buffers.objectCount(), buffers.cellCount()),
        visibility(store),
        budget(store),
        early(scene, gpu::kMarkEarly, {Submission::kInstanced, 100, scene.maxPatchTriangles > 0}),
        late(scene, gpu::kMarkLate, {Submission::kInstanced, 100, scene.maxPatchTriangles > 0}) {}

  void write(const Input& input) {
    store.states.write(0, std::as_bytes(std::span(input.states)));
    store.boxes.write(0, std::as_bytes(std::span(input.boxes)));
    store.marks.write(0, std::as_bytes(std::span(input.marks)));
    if (!input.cellMarks.empty()) store.cellMarks.write(0, std::as_bytes(std::span(input.cellMarks)));
  }

  void limit(const gpu::CullView& view, BudgetStage stage) {
    visibility.setView(view);
    budget.limit(buffers.bindings(), visibility.decided(), view, stage == BudgetStage::kEarly ? early : late);
  }

  const scene::SceneData& scene;
  render::SceneBuffers buffers;
  ObjectStore store;
  VisibilityPass visibility;
  BudgetPass budget;
  DrawList early;
  DrawList late;
};

class BudgetGl : public test::GlTest {
 protected:
  /// Runs one stage in both. @return objects that became coarser
  std::size_t expectStage(Machine& machine, const gpu::CullView& view, BudgetStage stage, Input& input) {
    const std::vector<gpu::ObjectState> before = input.states;
    const gpu::PriceState price = machine.store.price.read<gpu::PriceState>(1)[0];
    BudgetFrame frame{machine.scene, view, price, input.boxes, input.cellMarks, input.states, input.marks, words_};
    machine.limit(view, stage);
    limitTriangles(frame, stage);
    const auto states = machine.store.states.read<gpu::ObjectState>(input.states.size());
    const auto words = machine.store.budget.read<gpu::uint>(gpu::kBudgetWords);
    for (gpu::uint at = 0; at < gpu::kBudgetObjectGroups; ++at)
      EXPECT_EQ(words[at], words_[at]) << "word " << at;
    std::size_t coarser = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_EQ(states[i].lod, input.states[i].lod) << "object " << i;
      EXPECT_EQ(states[i].tessellation, input.states[i].tessellation) << "object " << i;
      const bool patches = has(view.traits, gpu::kTraitPatches);
      coarser += patches ? states[i].tessellation != before[i].tessellation : states[i].lod != before[i].lod;
    }
    EXPECT_EQ(machine.store.marks.read<gpu::uint>(input.marks.size()), input.marks);
    EXPECT_EQ(words[gpu::kBudgetObjectGroups] > 0, coarser > 0 || words[gpu::kBudgetForecast + 1] > 0);
    return coarser;
  }

  BudgetWords words_{};
};

TEST_F(BudgetGl, BothStagesEqualTheTwin) {
  Random random(5);
  const scene::SceneData scenes[] = {
      scene::buildScene(mixedFile(300)), scene::buildScene(mixedFile(300), {.patches = true}),
      scene::buildScene(mixedFile(100), {.cells = {scene::CellOptions::Kind::kCount, 16}})};
  std::size_t coarser = 0;
  for (const scene::SceneData& scene : scenes) {
    Machine machine(scene);
    for (const CullMode mode : {CullMode::kHiz, CullMode::kFrustum}) {
      for (const gpu::uint budget : {1U, 1000U, 20000U, 60000U, 0xffffffffU}) {
        SCOPED_TRACE(testing::Message() << scene.cells.objects.size() << ' ' << static_cast<int>(mode) << ' '
                                        << budget);
        const Detail detail = scene.maxPatchTriangles > 0 ? Detail::kTessellation : Detail::kDiscrete;
        gpu::CullView view =
            makeView(scene, {}, kSize, 0.0F, {.cullMode = mode, .lodRule = LodRule::kPrice, .detail = detail});
        view.cellCount = machine.buffers.cellCount();
        view.triangleBudget = budget;
        view.hysteresis = 2.0F;
        view.calm = random.below(2);
        Input input = randomInput(scene, random);
        machine.write(input);
        std::size_t changed = 0;
        if (mode == CullMode::kHiz) changed += expectStage(machine, view, BudgetStage::kEarly, input);
        changed += expectStage(machine, view, BudgetStage::kLate, input);
        EXPECT_TRUE(changed == 0 || budget < 0xffffffffU);
        coarser += changed;
      }
    }
  }
  EXPECT_GT(coarser, 500U);
}

TEST_F(BudgetGl, LevelsStayWhereTheFrameIsWithinItsBudgetAndTheSumIsWhatIsDrawn) {
  const scene::SceneData scene = scene::buildScene(mixedFile(300));
  Machine machine(scene);
  Random random(6);
  for (const bool twoPhases : {true, false}) {
    Input input = randomInput(scene, random);
    machine.write(input);
    gpu::CullView view =
        makeView(scene, {}, kSize, 0.0F,
                 {.cullMode = twoPhases ? CullMode::kHiz : CullMode::kFrustum, .lodRule = LodRule::kPrice});
    view.triangleBudget = 0xffffffffU;
    const std::uint64_t drawn = triangleSum(countStates(scene, view, input.states, input.marks));
    if (twoPhases) machine.limit(view, BudgetStage::kEarly);
    machine.limit(view, BudgetStage::kLate);
    BudgetWords words{};
    const auto read = machine.store.budget.read<gpu::uint>(gpu::kBudgetWords);
    std::copy(read.begin(), read.end(), words.begin());
    EXPECT_EQ(budgetSum(words, gpu::kBudgetDrawn) + budgetSum(words, gpu::kBudgetDrawn + 2), static_cast<float>(drawn));
    EXPECT_EQ(words[gpu::kBudgetObjectGroups], 0U);
    EXPECT_EQ(machine.store.marks.read<gpu::uint>(input.marks.size()), input.marks);
    // One triangle less than allowed is too many.
    view.triangleBudget = static_cast<gpu::uint>(static_cast<float>(drawn) / gpu::kBudgetLimitLate);
    machine.limit(view, BudgetStage::kLate);
    EXPECT_GT(machine.store.budget.read<gpu::uint>(gpu::kBudgetWords)[gpu::kBudgetObjectGroups], 0U);
  }
}

TEST_F(BudgetGl, ThePriceMovesAsTheTwinMovesIt) {
  const scene::SceneData scene = scene::buildScene(mixedFile(10));
  Machine machine(scene);
  Random random(21);
  gpu::PriceState expected = firstPrice();
  gpu::CullView view = makeView(scene, {}, kSize, 0.0F, {.cullMode = CullMode::kFrustum, .lodRule = LodRule::kPrice});
  view.hysteresis = 2.0F;
  for (int frame = 0; frame < 200; ++frame) {
    constexpr gpu::uint kBudgets[] = {1, 60000, 100000, 0xffffffffU};
    view.triangleBudget = kBudgets[frame / 10 % 4];
    view.calm = frame / 50 % 2;
    BudgetWords words{};
    const float close = random.below(3) == 0 ? 1.0F : std::exp(random.uniform(-1.0F, 1.0F));
    words[gpu::kBudgetWanted + 3] = static_cast<gpu::uint>(close * static_cast<float>(view.triangleBudget) / 1024.0F);
    words[gpu::kBudgetWanted] = random.below(1024);
    machine.visibility.setView(view);
    machine.store.budget.write(0, std::as_bytes(std::span(words)));
    machine.budget.movePrice(machine.visibility.decided(), machine.late);
    const float triangles = budgetSum(words, gpu::kBudgetWanted) + budgetSum(words, gpu::kBudgetWanted + 2);
    expected = adjustPrice(expected, triangles, view);
    const auto actual = machine.store.price.read<gpu::PriceState>(1)[0];
    ASSERT_NEAR(actual.logFine, expected.logFine, 1e-4F) << "frame " << frame;
    ASSERT_NEAR(actual.logCoarse, expected.logCoarse, 1e-4F) << "frame " << frame;
    ASSERT_EQ(actual.gain, expected.gain) << "frame " << frame;
    ASSERT_NEAR(actual.lastError, expected.lastError, 1e-5F) << "frame " << frame;
    expected = actual;  // so that roundings do not add up
  }
  machine.store.forget();
  EXPECT_EQ(machine.store.price.read<gpu::PriceState>(1)[0].logFine, 0.0F);
}

}  // namespace
}  // namespace jalousie::visibility
