// The kernels that build draw lists against their CPU twin, on random input and at the edges of their blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"
#include "visibility/draw_list_pass.h"
#include "visibility/kernel_input.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

bool sameCommand(const gpu::DrawCommand& a, const gpu::DrawCommand& b) {
  return a.count == b.count && a.instanceCount == b.instanceCount && a.firstIndex == b.firstIndex &&
         a.baseVertex == b.baseVertex && a.baseInstance == b.baseInstance;
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
      input.marks.push_back(random.below(8) | random.below(chain.lodCount) << gpu::kMarkMapLodShift |
                            (isMirrored(scene.transforms[scene.objects[i].transform]) ? gpu::kMarkMirrored : 0));
      if (chain.lodCount == 1 || random.below(3) > 0) continue;
      const gpu::uint lod = input.states.back().lod;
      const bool fromCoarser = lod == 0 || (lod + 1 < chain.lodCount && random.below(2) == 0);
      input.marks.back() |= (1 + random.below(gpu::kDefaultFadeFrames)) << gpu::kMarkFadeShift |
                            (fromCoarser ? gpu::kMarkFromCoarser : 0);
    }
    return input;
  }

  /// An instance has a slot if and only if it is on the list.
  static void expectPlaced(const std::vector<gpu::uint>& slots, const std::vector<std::uint8_t>& placed) {
    ASSERT_EQ(slots.size(), 2 * placed.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      ASSERT_EQ(slots[2 * i] != gpu::kNoBin, (placed[i] & kPlacedOwn) != 0) << "object " << i;
      ASSERT_EQ(slots[2 * i + 1] != gpu::kNoBin, (placed[i] & kPlacedFadingOut) != 0) << "object " << i;
    }
  }

  /// Builds one list on the GPU and compares instances, commands and counts with the twin.
  static void compare(const SceneData& scene, const gpu::CullView& view, gpu::uint phase,
                      const DrawListOptions& options, const Input& input) {
    const render::SceneBuffers buffers(scene);
    ObjectStore objects(buffers.objectCount());
    VisibilityPass pass(objects);
    pass.setView(view);
    objects.states.write(0, std::as_bytes(std::span(input.states)));
    objects.boxes.write(0, std::as_bytes(std::span(input.boxes)));
    DrawListPass lists(scene);
    DrawList list(scene, phase, options);
    // The second run starts from the leftovers of a frame that draws everything.
    const std::vector<gpu::uint> all(input.marks.size(), gpu::kMarkEarly | gpu::kMarkLate);
    for (const std::vector<gpu::uint>& marks : {all, input.marks}) {
      objects.marks.write(0, std::as_bytes(std::span(marks)));
      lists.build(list, buffers.bindings(), pass.decided());
    }
    const DrawLists expected = buildDrawLists(scene, view, {input.states, input.boxes, input.marks}, phase, options);
    const auto instances = list.instances().read<gpu::uint>(expected.instances.size());
    EXPECT_EQ(instances, expected.instances);
    const auto counts = list.drawCounts().read<gpu::uint>(gpu::kDrawCounts);
    EXPECT_EQ(counts[gpu::kCountInstances], expected.instances.size());
    expectPlaced(list.slots().read<gpu::uint>(2 * scene.objects.size()), expected.placed);
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
  for (const std::uint32_t instances :
       {450U, 3000U}) {  // 3 and 20 objects in a tile: a thread and a workgroup for each
    file.instances.clear();
    for (std::uint32_t i = 0; i < instances; ++i)
      test::addInstance(file, (i * 7919U) % 150, {0, 0, 0}, {i % 5 == 0 ? -1.0F : 1.0F, 1, 1});
    const SceneData scene = scene::buildScene(file);
    EXPECT_GT(scene.binLayout.bins.size(), 4 * gpu::kScanGroupSize);
    const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz});
    Input input = randomInput(scene, 20, 6);
    for (const Submission submission : {Submission::kInstanced, Submission::kPerObject})
      compare(scene, view, gpu::kMarkLate, {submission, instances, false}, input);
    for (std::size_t i = 0; i < input.marks.size(); ++i)
      if (i % 97 != 5) input.marks[i] = 0;  // most rounds have nothing to draw
    compare(scene, view, gpu::kMarkLate, {Submission::kInstanced, instances, false}, input);
  }
}

}  // namespace
}  // namespace jalousie::visibility
