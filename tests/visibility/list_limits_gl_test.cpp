// Draw lists of scenes with more than 2^20 entries of (chain, bin, tile): the sums of the blocks then take several
// rounds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/draw_list_pass.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {
namespace {

constexpr gpu::uint kOneRound = gpu::kScanBlock * gpu::kScanBlock;  ///< entries whose block sums take one round

class PrefixSumGl : public test::GlTest {
 protected:
  /// The offset of every entry, from both dispatches of the scan kernel.
  std::vector<gpu::uint> scan(const std::vector<gpu::uint>& counts) const {
    const auto entryCount = static_cast<gpu::uint>(counts.size());
    const gpu::uint blocks = (entryCount + gpu::kScanBlock - 1) / gpu::kScanBlock;
    gpu::ListView view{};
    view.entryCount = entryCount;
    const gl::Buffer viewBuffer(sizeof view, 0, "list view", &view);
    const gl::Buffer entries = gl::Buffer::fromArray(std::span<const gpu::uint>(counts), "entries");
    const gl::Buffer sums(sizeof(gpu::uint) * blocks, 0, "block sums");
    viewBuffer.bindUniform(gpu::kBindingListView);
    entries.bindStorage(gpu::kBindingEntries);
    sums.bindStorage(gpu::kBindingBlockSums);
    const auto run = [](const gl::Program& program, std::uint32_t groups) {
      program.use();
      glDispatchCompute(groups, 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    };
    run(gl::Program(programSource(ProgramId::kScanEntries)), blocks);
    run(gl::Program(programSource(ProgramId::kScanSums)), 1);
    std::vector<gpu::uint> offsets = entries.read<gpu::uint>(entryCount);
    const std::vector<gpu::uint> before = sums.read<gpu::uint>(blocks);
    for (std::size_t i = 0; i < offsets.size(); ++i)
      offsets[i] += before[i / gpu::kScanBlock];
    return offsets;
  }
};

TEST_F(PrefixSumGl, EqualsTheSerialSumBelowAtAndAboveOneRound) {
  for (const gpu::uint entryCount : {1U, 2U, gpu::kScanBlock, gpu::kScanBlock + 1, kOneRound - 1, kOneRound,
                                     kOneRound + 1, kOneRound + gpu::kScanBlock + 1, 3 * kOneRound + 12345}) {
    Random random(entryCount);
    std::vector<gpu::uint> counts(entryCount);
    for (gpu::uint& count : counts)
      count = random.below(3) == 0 ? random.below(129) : 0;
    std::vector<gpu::uint> expected(entryCount);
    counts.back() = 0;
    std::exclusive_scan(counts.begin(), counts.end(), expected.begin(), 0U);
    EXPECT_EQ(scan(counts), expected) << entryCount << " entries";
  }
}

/// One object per chain; all chains have the same ten levels.
scene::SceneData manyChains(std::uint32_t count) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes = {{"box", {test::box(glm::vec3(1.0F))}}};
  file.chains = {{"chain", {}}};
  for (int level = 0; level < 10; ++level)
    file.chains[0].levels.push_back({0, 0.01F * static_cast<float>(level)});
  file.chains.resize(count, file.chains[0]);
  for (std::uint32_t i = 0; i < count; ++i)
    test::addInstance(file, i, {static_cast<float>(i % 256), 0, std::floor(static_cast<float>(i) / 256.0F)},
                      {i % 5 == 0 ? -1.0F : 1.0F, 1, 1});
  return scene::buildScene(file);
}

class ListLimitsGl : public test::GlTest {};

/// More entries than one round adds up, and more tiles than a row of workgroups holds.
TEST_F(ListLimitsGl, SeventyThousandChainsOfTenLevelsGiveTheListsOfTheTwin) {
  const scene::SceneData scene = manyChains(70000);
  ASSERT_GT(scene.binLayout.entryCount, kOneRound);
  ASSERT_GT(scene.binLayout.tiles.size(), 65535U);
  const auto count = static_cast<std::uint32_t>(scene.objects.size());
  Random random(3);
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::uint> marks;
  for (std::uint32_t i = 0; i < count; ++i) {
    states.push_back({gpu::kVerdictPartial, random.below(10), 1, -1.0F});
    marks.push_back((random.below(4) == 0 ? 0 : gpu::kMarkLate) | (i % 5 == 0 ? gpu::kMarkMirrored : 0));
  }
  const std::vector<gpu::ScreenBox> boxes(count, {0, 0, 1, 1, 0.5F, 1.0F, 1.0F, 0});
  gpu::CullView view{};
  view.objectCount = count;
  const render::SceneBuffers buffers(scene);
  const gl::Buffer viewBuffer(sizeof view, 0, "view", &view);
  const gl::Buffer stateBuffer = gl::Buffer::fromArray(std::span<const gpu::ObjectState>(states), "states");
  const gl::Buffer boxBuffer = gl::Buffer::fromArray(std::span<const gpu::ScreenBox>(boxes), "boxes");
  const gl::Buffer markBuffer = gl::Buffer::fromArray(std::span<const gpu::uint>(marks), "marks");
  DrawListPass pass(scene);
  DrawList list(scene, gpu::kMarkLate, {Submission::kInstanced, count, false});
  pass.build(list, buffers.bindings(), {&viewBuffer, &stateBuffer, &boxBuffer, &markBuffer});

  const DrawLists expected =
      buildDrawLists(scene, view, {states, boxes, marks}, gpu::kMarkLate, {Submission::kInstanced, count, false});
  EXPECT_EQ(list.instances().read<gpu::uint>(expected.instances.size()), expected.instances);
  const auto counts = list.drawCounts().read<gpu::uint>(gpu::kDrawCounts);
  EXPECT_EQ(counts[gpu::kCountInstances], expected.instances.size());
  for (gpu::uint kind = 0; kind < gpu::kListsPerDetail; ++kind) {
    const std::vector<gpu::DrawCommand>& wanted = expected.commands[kind];
    ASSERT_EQ(counts[kind], wanted.size());
    const auto actual = list.commands().read<gpu::DrawCommand>(
        wanted.size(), sizeof(gpu::DrawCommand) * std::size_t{kind} * list.commandCapacity());
    EXPECT_TRUE(wanted.empty() ||
                std::memcmp(actual.data(), wanted.data(), sizeof(gpu::DrawCommand) * wanted.size()) == 0)
        << "list " << kind;
  }
}

}  // namespace
}  // namespace jalousie::visibility
