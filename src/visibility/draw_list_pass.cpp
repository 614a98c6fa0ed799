// Five dispatches per list: bin, scan, scan the sums, scatter, write commands.
#include "visibility/draw_list_pass.h"

#include <algorithm>

#include "scene/scene_data.h"
#include "shared/face_structs.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"
#include "visibility/storage.h"

namespace jalousie::visibility {
namespace {

constexpr std::size_t kFewObjects = 16;  // in a tile, on average

/// Whether one thread handles a whole tile. Where tiles have few objects, most threads of a workgroup would be idle; of
/// cells, most are culled.
bool givesTilesToThreads(const scene::SceneData& scene) {
  const scene::DrawTables& drawn = scene.drawn();
  return !scene.cells.objects.empty() || kFewObjects * drawn.binLayout.tiles.size() > drawn.objects.size();
}

static_assert(gpu::kMaxBinsPerChain == 2 * gpu::kMaxLods && gpu::kMaxBinsPerChain <= gpu::kObjectGroupSize,
              "one thread of a tile writes each bin's count");
static_assert(gpu::kScanBlock == gpu::kScanGroupSize * gpu::kScanEntriesPerThread);
static_assert(gpu::kMaxBinsPerChain <= 1U << gpu::kSlotBinBits);

gpu::ListView makeView(const scene::SceneData& scene, gpu::uint phase, const DrawListOptions& options) {
  gpu::ListView view{};
  view.phase = phase;
  const scene::BinLayout& layout = scene.drawn().binLayout;
  view.tileCount = static_cast<gpu::uint>(layout.tiles.size());
  view.binCount = static_cast<gpu::uint>(layout.bins.size());
  view.entryCount = layout.entryCount;
  view.capacity = options.capacity;
  view.commandCapacity = options.submission == Submission::kInstanced ? view.binCount : options.capacity;
  // A range each, and the double-sided triangles.
  if (options.faceRanges > 0)
    view.commandCapacity = std::max(view.commandCapacity, options.capacity * (options.faceRanges + 1));
  view.patches = options.patches ? 1 : 0;
  return view;
}

std::size_t commandBytes(const gpu::ListView& view) {
  return sizeof(gpu::DrawCommand) * (view.patches != 0 ? gpu::kListCount : gpu::kListsPerDetail) * view.commandCapacity;
}

}  // namespace

DrawList::DrawList(const scene::SceneData& scene, gpu::uint phase, const DrawListOptions& options)
    : options_(options),
      view_(makeView(scene, phase, options)),
      viewBuffer_(sizeof(gpu::ListView), 0, "draw list view", &view_),
      instances_(makeStorage(sizeof(gpu::uint) * options.capacity, 0, "instance list")),
      commands_(makeStorage(commandBytes(view_), 0, "draw commands")),
      drawCounts_(makeStorage(sizeof(gpu::uint) * gpu::kDrawCounts, 0, "draw counts")),
      slots_(makeStorage(2 * sizeof(gpu::uint) * scene.drawn().objects.size(), 0, "slots")),
      faceFigures_(makeStorage(gpu::kFaceFigures * sizeof(gpu::uint), 0, "figures of back faces")) {}

DrawListPass::DrawListPass(const scene::SceneData& scene, const gl::ShaderLibrary& shaders)
    : tileCount_(static_cast<std::uint32_t>(scene.drawn().binLayout.tiles.size())),
      tilePerThread_(givesTilesToThreads(scene)),
      blockCount_((scene.drawn().binLayout.entryCount + gpu::kScanBlock - 1) / gpu::kScanBlock),
      binProgram_(programSource(tilePerThread_ ? ProgramId::kBinObjectsPerThread : ProgramId::kBinObjects), shaders),
      scanEntriesProgram_(programSource(ProgramId::kScanEntries), shaders),
      scanSumsProgram_(programSource(ProgramId::kScanSums), shaders),
      scatterProgram_(programSource(tilePerThread_ ? ProgramId::kScatterPerThread : ProgramId::kScatter), shaders),
      scatterPerObjectProgram_(
          programSource(tilePerThread_ ? ProgramId::kScatterPerObjectAndThread : ProgramId::kScatterPerObject),
          shaders),
      writeCommandsProgram_(programSource(ProgramId::kWriteCommands), shaders),
      writeCountsProgram_(programSource(ProgramId::kWriteCounts), shaders),
      tiles_(gl::Buffer::fromArray(std::span<const gpu::Tile>(scene.drawn().binLayout.tiles), "tiles")),
      bins_(gl::Buffer::fromArray(std::span<const gpu::Bin>(scene.drawn().binLayout.bins), "bins")),
      entries_(makeStorage(sizeof(gpu::uint) * scene.drawn().binLayout.entryCount, 0, "bin counts")),
      blockSums_(makeStorage(sizeof(gpu::uint) * blockCount_, 0, "block sums")) {}

void DrawListPass::bind(const DrawList& list, const SceneBindings& tables, const ObjectBuffers& objects) const {
  const SceneBindings scene = tables.drawn();
  const ObjectBuffers decided = objects.drawn();
  decided.view->bindUniform(gpu::kBindingCullView);
  list.viewBuffer_.bindUniform(gpu::kBindingListView);
  tiles_.bindStorage(gpu::kBindingTiles);
  list.slots_.bindStorage(gpu::kBindingSlots);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingMarks);
  entries_.bindStorage(gpu::kBindingEntries);
}

void DrawListPass::build(DrawList& list, const SceneBindings& scene, const ObjectBuffers& decided) {
  if (tileCount_ == 0) return;
  const bool perObject = list.options_.submission == Submission::kPerObject;
  list.faceFigures_.clear();
  bind(list, scene, decided);
  const auto run = [](const gl::Program& program, std::uint32_t groups) {
    program.use();
    dispatchGroups(groups);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  const std::uint32_t groups = tilePerThread_ ? objectGroups(tileCount_) : tileCount_;
  run(binProgram_, groups);
  blockSums_.bindStorage(gpu::kBindingBlockSums);
  run(scanEntriesProgram_, blockCount_);
  run(scanSumsProgram_, 1);
  list.instances_.bindStorage(gpu::kBindingInstances);
  list.commands_.bindStorage(gpu::kBindingCommands);
  if (perObject) list.commands_.clear();
  run(perObject ? scatterPerObjectProgram_ : scatterProgram_, groups);
  bins_.bindStorage(gpu::kBindingBins);
  list.drawCounts_.bindStorage(gpu::kBindingDrawCounts);
  run(perObject ? writeCountsProgram_ : writeCommandsProgram_, 1);
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace jalousie::visibility
