// The kernels that cull groups of back faces against their CPU twin, on random states and transforms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"
#include "visibility/face_pass.h"
#include "visibility/face_reference.h"
#include "visibility/kernel_input.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

struct FaceInput {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::uint> marks;
};

FaceInput randomFaceInput(const scene::DrawTables& tables, const scene::SceneData& scene, std::uint64_t seed) {
  Random random(seed);
  FaceInput input;
  for (const gpu::Object& object : tables.objects) {
    const gpu::uint lods = tables.chains[object.chain].lodCount;
    const gpu::uint lod = random.below(lods);
    gpu::uint mark = random.below(8) | (isMirrored(scene.transforms[object.transform]) ? gpu::kMarkMirrored : 0);
    if (lods > 1 && random.below(4) == 0) {
      const bool coarser = lod == 0 || (lod + 1 < lods && random.below(2) == 0);
      mark |= (1 + random.below(4)) << gpu::kMarkFadeShift | (coarser ? gpu::kMarkFromCoarser : 0);
    }
    input.states.push_back({gpu::kVerdictPending, lod, 1, -1.0F});
    input.marks.push_back(mark);
  }
  return input;
}

class FaceGl : public test::GlTest {
 protected:
  /// A scene on the GPU, and a list of random instances of it.
  struct Frame {
    Frame(const scene::SceneData& sceneData, const DrawListOptions& options)
        : scene(sceneData),
          buffers(scene),
          objects(buffers.objectCount(), buffers.cellCount()),
          pass(objects),
          lists(scene),
          list(scene, gpu::kMarkLate, options),
          work(list),
          faces(scene.faces) {}

    void build(const gpu::CullView& view, std::uint64_t seed) {
      pass.setView(view);
      const bool cells = buffers.cellCount() > 0;
      const FaceInput input = randomFaceInput(scene.drawn(), scene, seed);
      (cells ? objects.cellStates : objects.states).write(0, std::as_bytes(std::span(input.states)));
      (cells ? objects.cellMarks : objects.marks).write(0, std::as_bytes(std::span(input.marks)));
      lists.build(list, buffers.bindings(), pass.decided());
    }

    /// The list as the twin takes it.
    std::vector<FaceInstance> instances() const {
      const gpu::uint count = list.drawCounts().read<gpu::uint>(gpu::kDrawCounts)[gpu::kCountInstances];
      const auto slots = list.slots().read<gpu::uint>(2 * scene.drawn().objects.size());
      std::vector<FaceInstance> result;
      for (const gpu::uint entry : list.instances().read<gpu::uint>(count)) {
        const gpu::uint id = entry & gpu::kInstanceObject;
        const gpu::uint slot = slots[2 * id + ((entry & gpu::kInstanceFadingOut) != 0 ? 1 : 0)];
        result.push_back({id, slot & ((1U << gpu::kSlotBinBits) - 1)});
      }
      return result;
    }

    const scene::SceneData& scene;
    render::SceneBuffers buffers;
    ObjectStore objects;
    VisibilityPass pass;
    DrawListPass lists;
    DrawList list;
    FaceWork work;
    FacePass faces;
  };

  static std::uint64_t figure(const std::vector<gpu::uint>& words, gpu::uint at) {
    return words[at] + (std::uint64_t{words[at + 1]} << 10U);
  }

  static void expectCommands(const Frame& frame, const FaceCommands& expected) {
    const auto counts = frame.list.drawCounts().read<gpu::uint>(gpu::kDrawCounts);
    const std::size_t capacity = frame.list.commandCapacity();
    const auto all = frame.list.commands().read<gpu::DrawCommand>(gpu::kListsPerDetail * capacity);
    for (const gpu::uint list : {gpu::kListSolid, gpu::kListSheet}) {
      const std::vector<gpu::DrawCommand>& wanted = expected.commands[list];
      ASSERT_EQ(counts[list], wanted.size()) << "list " << list;
      for (std::size_t i = 0; i < capacity; ++i) {
        const gpu::DrawCommand& actual = all[list * capacity + i];
        if (i >= wanted.size()) {
          ASSERT_EQ(actual.instanceCount * actual.count, 0U) << "list " << list << " command " << i;
          continue;
        }
        ASSERT_EQ(actual.count, wanted[i].count) << "list " << list << " command " << i;
        ASSERT_EQ(actual.firstIndex, wanted[i].firstIndex) << "list " << list << " command " << i;
        ASSERT_EQ(actual.baseVertex, wanted[i].baseVertex);
        ASSERT_EQ(actual.baseInstance, wanted[i].baseInstance);
        ASSERT_EQ(actual.instanceCount, 1U);
      }
    }
    const auto figures = frame.list.faceFigures().read<gpu::uint>(gpu::kFaceFigures);
    EXPECT_EQ(figure(figures, gpu::kFaceFigureTested), expected.tested);
    EXPECT_EQ(figure(figures, gpu::kFaceFigureCulled), expected.culled);
    EXPECT_EQ(figure(figures, gpu::kFaceFigureWhole), expected.whole);
  }

  /// @return  triangles that were culled
  static std::uint64_t compare(const scene::SceneData& scene, const DrawListOptions& options, std::uint64_t seed) {
    Frame frame(scene, options);
    Random random(seed);
    std::uint64_t culled = 0;
    for (gpu::uint test = gpu::kFacesMask; test <= gpu::kFacesCone; ++test) {
      for (int place = 0; place < 6; ++place) {
        const float reach = place < 2 ? 2.0F : 30.0F;
        const auto along = [&] { return random.uniform(-reach, reach); };
        scene::Camera camera = scene::lookAt({along(), along(), along()}, {0.1F, 0.2F, 0.3F}, scene.boundsWorld);
        if (place == 5) camera.halfSize = glm::vec2(16.0F, 9.0F);
        gpu::CullView view = makeView(scene, camera, {640, 360}, 0.0F, {.cullMode = CullMode::kHiz});
        view.cellCount = frame.buffers.cellCount();
        frame.build(view, seed + test);
        frame.faces.cull(frame.list, frame.work, {test, options.faceRanges, 0, 0}, frame.buffers.transforms(),
                         *frame.pass.decided().view);
        const FaceCommands expected =
            cullFaces(scene.faces, scene.transforms, view, {test, options.faceRanges, 0, 0}, frame.instances());
        expectCommands(frame, expected);
        if (HasFatalFailure()) return 0;
        culled += expected.culled;
      }
    }
    return culled;
  }
};

TEST_F(FaceGl, EqualsTheTwinForEveryTest) {
  for (const asset::FaceGrouping grouping :
       {asset::FaceGrouping::kMasks, asset::FaceGrouping::kClusters, asset::FaceGrouping::kMeshlets}) {
    asset::SceneFile file = mixedFile(150);
    test::groupFaces(file, grouping);
    const scene::SceneData scene = scene::buildScene(file, {.faces = true});
    for (const std::uint32_t ranges : {100U, 4U, 1U})
      for (const std::uint32_t capacity : {300U, 40U, 1U})
        compare(scene, {Submission::kInstanced, capacity, false, ranges}, 21);
    EXPECT_GT(compare(scene, {Submission::kPerObject, 300, false, 100}, 22), 1000U);
  }
}

TEST_F(FaceGl, EqualsTheTwinWithCells) {
  const asset::SceneFile file = test::randomSpheres(40, 6.0F, 3);
  const scene::SceneData scene =
      scene::buildScene(file, {.cells = {scene::CellOptions::Kind::kCount, 32}, .faces = true});
  ASSERT_FALSE(scene.cells.objects.empty());
  const auto units = static_cast<std::uint32_t>(scene.cells.objects.size());
  EXPECT_GT(compare(scene, {Submission::kInstanced, 2 * units, false, 4}, 23), 1000U)
      << "without groups in the file a cell is one group";
}

}  // namespace
}  // namespace jalousie::visibility
