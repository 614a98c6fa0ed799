// The kernels of frames drawn in slices against their CPU twins.
#include <gtest/gtest.h>

#include <cstring>
#include <optional>

#include "core/random.h"
#include "render/slice_pass.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/draw_lists_reference.h"
#include "visibility/face_pass.h"
#include "visibility/face_reference.h"
#include "visibility/kernel_input.h"
#include "visibility/lod_policy.h"
#include "visibility/slice_reference.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

/// States and marks of one frame.
struct Decisions {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
  std::vector<gpu::uint> marks;
};

/// Random verdicts, levels, phases and cross-fades.
Decisions randomDecisions(const scene::DrawTables& scene, std::uint64_t seed) {
  Random random(seed);
  Decisions result;
  for (const gpu::Object& object : scene.objects) {
    const gpu::uint lods = scene.chains[object.chain].lodCount;
    const gpu::uint lod = random.below(lods);
    gpu::uint mark = random.below(8) | (random.below(4) == 0 ? gpu::kMarkMirrored : 0);
    if (lods > 1 && random.below(3) == 0) {
      const bool coarser = lod == 0 || (lod + 1 < lods && random.below(2) == 0);
      mark |= (1 + random.below(4)) << gpu::kMarkFadeShift | (coarser ? gpu::kMarkFromCoarser : 0);
    }
    result.states.push_back({gpu::kVerdictPending, lod, 1 + random.below(3), -1.0F});
    result.boxes.push_back({0, 0, 1, 1, 0.5F, 1.0F, 1.0F, 0});
    result.marks.push_back(mark);
  }
  return result;
}

void upload(gl::Buffer& buffer, const auto& values) {
  if (!values.empty()) buffer.write(0, std::as_bytes(std::span(values)));
}

class SlicesGl : public test::GlTest {
 protected:
  /// The kernels of one frame with random decisions, and what they left.
  struct Kernels {
    explicit Kernels(const scene::SceneData& sceneData, const FramePolicy& policy)
        : scene(sceneData),
          tree(culling::buildHierarchy(scene)),
          buffers(scene),
          store(buffers.objectCount(), buffers.cellCount()),
          pass(store),
          view(makeView(scene, {}, {64, 64}, 0.0F, policy)),
          slices(gl::ShaderLibrary()) {
      view.cellCount = buffers.cellCount();
      pass.setView(view);
      slices.allocate(scene, static_cast<std::uint32_t>(tree.nodes.size()));
      order.follow(scene, tree);
      slices.setOrder(order);
      objects = randomDecisions(scene, 5);
      upload(store.states, objects.states);
      upload(store.marks, objects.marks);
      if (buffers.cellCount() == 0) return;
      cells = randomDecisions(scene.cells, 6);
      upload(store.cellStates, cells.states);
      upload(store.cellMarks, cells.marks);
    }

    const scene::SceneData& scene;
    culling::SpatialHierarchy tree;
    render::SliceOrder order;
    render::SceneBuffers buffers;
    ObjectStore store;
    VisibilityPass pass;
    gpu::CullView view;
    render::SlicePass slices;
    Decisions objects;
    Decisions cells;
  };

  static void expectCommands(Kernels& kernels) {
    const bool hasCells = kernels.buffers.cellCount() > 0;
    const Decisions& units = hasCells ? kernels.cells : kernels.objects;
    const gpu::uint lists = kernels.scene.maxPatchTriangles > 0 ? gpu::kListCount : gpu::kListsPerDetail;
    const SliceLists expected = buildSlices(kernels.scene.drawn(), kernels.view,
                                            {units.states, units.boxes, units.marks}, kernels.order.units, lists);
    const render::SliceList list = kernels.slices.list(false);
    const auto commands = list.commands->read<gpu::DrawCommand>(expected.commands.size());
    const auto instances = list.instances->read<gpu::uint>(expected.instances.size());
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < commands.size(); ++i) {
      const gpu::DrawCommand& wanted = expected.commands[i];
      ASSERT_EQ(commands[i].instanceCount, wanted.instanceCount) << i;
      ASSERT_EQ(commands[i].count, wanted.count) << i;
      if (wanted.instanceCount == 0) continue;
      ++drawn;
      ASSERT_EQ(commands[i].firstIndex, wanted.firstIndex) << i;
      ASSERT_EQ(commands[i].baseVertex, wanted.baseVertex) << i;
      ASSERT_EQ(commands[i].baseInstance, wanted.baseInstance) << i;
      ASSERT_EQ(instances[wanted.baseInstance], expected.instances[wanted.baseInstance]) << i;
    }
    EXPECT_GT(drawn, 50U);
  }

  /// What the twin takes for each place.
  static std::vector<std::optional<FaceInstance>> instancesOf(const Kernels& kernels) {
    const Decisions& units = kernels.buffers.cellCount() > 0 ? kernels.cells : kernels.objects;
    const std::vector<gpu::uint>& order = kernels.order.units;
    std::vector<std::optional<FaceInstance>> places(2 * order.size());
    for (std::size_t place = 0; place < order.size(); ++place) {
      const gpu::uint id = order[place];
      const gpu::uint mark = units.marks[id];
      const bool fades = (mark & gpu::kMarkFadeMask) != 0;
      if ((mark & gpu::kMarkLate) == 0) continue;
      const gpu::uint lod = units.states[id].lod;
      const bool sheet = fades || (mark & gpu::kMarkMirrored) != 0;
      places[place] = FaceInstance{id, 2 * lod + (sheet ? 1U : 0U)};
      if (!fades) continue;
      places[place + order.size()] = FaceInstance{id, 2 * fadingLod(lod, mark) + 1};
    }
    return places;
  }

  static std::uint64_t expectFaceCommands(Kernels& kernels, gpu::uint test) {
    FacePass faces(kernels.scene.faces);
    kernels.slices.begin(kernels.buffers.bindings(), kernels.pass.decided(), {.threshold = 7}, {&faces, test});
    const render::SliceList list = kernels.slices.list(false);
    const auto wanted = sliceFaces(kernels.scene.faces, kernels.scene.transforms, kernels.view,
                                   {test, list.each - 1, 0, 0}, instancesOf(kernels));
    EXPECT_EQ(wanted.size(), std::size_t{2} * list.capacity);
    const auto commands = list.commands->read<gpu::DrawCommand>(wanted.size());
    std::uint64_t indices = 0;
    for (std::size_t i = 0; i < commands.size(); ++i) {
      indices += wanted[i].count;
      const bool equal = std::memcmp(&commands[i], &wanted[i], sizeof wanted[i]) == 0;
      EXPECT_TRUE(equal) << i << " test " << test;
      if (!equal) return 0;
    }
    return indices / 3;
  }

  static void expectHiding(Kernels& kernels) {
    Random random(3);
    std::vector<std::uint32_t> bits((kernels.order.objects.size() + 31) / 32);
    for (std::uint32_t& word : bits)
      word = random.next();
    std::vector<gpu::uint> samples(kernels.tree.nodes.size(), gpu::kSamplesUnknown);
    hideObjects({kernels.order.objects, bits, kernels.order.leafOf, samples, 7},
                {kernels.objects.states, kernels.objects.marks});
    hideCells(kernels.scene.cells.objects, {kernels.objects.states, kernels.objects.marks},
              {kernels.cells.states, kernels.cells.marks});
    kernels.slices.hide(kernels.buffers.bindings(), kernels.pass.decided(), bits);
    EXPECT_EQ(kernels.store.marks.read<gpu::uint>(kernels.objects.marks.size()), kernels.objects.marks);
    const auto states = kernels.store.states.read<gpu::ObjectState>(kernels.objects.states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      ASSERT_EQ(states[i].verdict, kernels.objects.states[i].verdict) << i;
    if (kernels.buffers.cellCount() == 0) return;
    EXPECT_EQ(kernels.store.cellMarks.read<gpu::uint>(kernels.cells.marks.size()), kernels.cells.marks);
  }
};

TEST_F(SlicesGl, CommandsAndMarksAgreeWithTheTwins) {
  for (const int variant : {0, 1, 2}) {
    scene::BuildOptions build{.patches = variant == 1};
    if (variant == 2) build.cells = {scene::CellOptions::Kind::kCount, 64};
    const scene::SceneData scene = scene::buildScene(mixedFile(500), build);
    ASSERT_EQ(scene.cells.objects.empty(), variant != 2);
    FramePolicy policy{.cullMode = CullMode::kChc, .lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone};
    if (variant == 1) policy.detail = Detail::kTessellation;
    Kernels kernels(scene, policy);
    kernels.slices.begin(kernels.buffers.bindings(), kernels.pass.decided(), {.threshold = 7});
    expectCommands(kernels);
    expectHiding(kernels);
  }
}

TEST_F(SlicesGl, CommandsWithoutBackFacesAgreeWithTheTwin) {
  for (const bool cells : {false, true}) {
    asset::SceneFile file = mixedFile(300);
    test::groupFaces(file, asset::FaceGrouping::kClusters);
    scene::BuildOptions build{.faces = true};
    if (cells) build.cells = {scene::CellOptions::Kind::kCount, 64};
    const scene::SceneData scene = scene::buildScene(file, build);
    Kernels kernels(scene,
                    {.cullMode = CullMode::kChc, .lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone});
    std::uint64_t drawn[gpu::kFacesCone + 1];
    for (gpu::uint test = gpu::kFacesMask; test <= gpu::kFacesCone; ++test)
      drawn[test] = expectFaceCommands(kernels, test);
    EXPECT_LT(drawn[gpu::kFacesCluster], drawn[gpu::kFacesMask]);
    kernels.slices.begin(kernels.buffers.bindings(), kernels.pass.decided(), {.threshold = 7});
    expectCommands(kernels);  // the plain commands again
  }
}

/// What is drawn if a range was not seen: nothing of it, in either half of the places.
TEST_F(SlicesGl, HiddenRangesLoseTheirCommandsWithAndWithoutBackFaces) {
  asset::SceneFile file = mixedFile(200);
  test::groupFaces(file, asset::FaceGrouping::kClusters);
  const scene::SceneData scene = scene::buildScene(file, {.faces = true});
  Kernels kernels(scene, {.cullMode = CullMode::kQueryBuffer, .lodRule = LodRule::kPixelError});
  FacePass faces(scene.faces);
  for (const gpu::uint test : {gpu::kFacesOff, gpu::kFacesTree}) {
    const render::SliceFaces own = test == gpu::kFacesOff ? render::SliceFaces{} : render::SliceFaces{&faces, test};
    kernels.slices.begin(kernels.buffers.bindings(), kernels.pass.decided(), {.threshold = 7}, own);
    const render::SliceList list = kernels.slices.list(false);
    const std::size_t total = std::size_t{2} * list.capacity;
    const auto before = list.commands->read<gpu::DrawCommand>(total);
    const GLuint samplesOf[] = {7, 8};  // the threshold is 7
    for (const std::size_t node : {0U, 1U})
      glClearNamedBufferSubData(kernels.slices.samples().id(), GL_R32UI, static_cast<GLintptr>(4 * node), 4,
                                GL_RED_INTEGER, GL_UNSIGNED_INT, &samplesOf[node]);
    const gpu::SliceRange ranges[] = {{30, 70, 0, 0}, {120, 20, 1, 0}};
    kernels.slices.dropHidden(ranges);
    const auto after = list.commands->read<gpu::DrawCommand>(total);
    const std::size_t places = kernels.order.units.size();
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < total; ++i) {
      const std::size_t place = i / list.each % places;
      const bool hidden = place >= 30 && place < 100;
      ASSERT_EQ(after[i].count, hidden ? 0 : before[i].count) << i;
      dropped += hidden && before[i].count > 0 ? 1 : 0;
    }
    EXPECT_GT(dropped, 20U);
  }
}

}  // namespace
}  // namespace jalousie::visibility
