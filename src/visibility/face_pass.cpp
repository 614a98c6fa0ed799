// Four dispatches per list: ranges, two of the prefix sum, commands.
#include "visibility/face_pass.h"

#include <algorithm>

#include "core/check.h"
#include "scene/face_tables.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"
#include "visibility/storage.h"

namespace jalousie::visibility {
namespace {

std::size_t workBytes(const gpu::ListView& view, std::uint32_t ranges) {
  const std::size_t capacity = view.capacity;
  return sizeof(gpu::uint) * (view.entryCount + capacity * (gpu::kFaceHead + 2 * ranges) + 2);
}

/// The prefix sum runs over the numbers of commands of both lists.
gpu::ListView scanView(gpu::ListView view) {
  view.entryCount = 2 * view.capacity + 1;
  return view;
}

}  // namespace

std::uint32_t faceRanges(std::uint64_t mostGroups, std::uint64_t capacity, std::uint32_t most) {
  if (mostGroups == 0) return 0;
  const std::uint64_t each = std::max<std::uint64_t>(most / std::max<std::uint64_t>(capacity, 1), kLeastFaceRanges);
  return static_cast<std::uint32_t>(std::min(each, std::max<std::uint64_t>(mostGroups, kLeastFaceRanges)));
}

FaceWork::FaceWork(const DrawList& list)
    : view_(scanView(list.view())),
      ranges_(list.options().faceRanges),
      viewBuffer_(sizeof(gpu::ListView), 0, "list view of back faces", &view_),
      words_(makeStorage(workBytes(view_, ranges_), 0, "work of back faces")),
      blockSums_(makeStorage(sizeof(gpu::uint) * (view_.entryCount / gpu::kScanBlock + 1), 0, "sums of back faces")) {}

FacePass::FacePass(const scene::FaceTables& faces, const gl::ShaderLibrary& shaders)
    : rangesProgram_(programSource(ProgramId::kFaceRanges), shaders),
      scanEntriesProgram_(programSource(ProgramId::kScanEntries), shaders),
      scanSumsProgram_(programSource(ProgramId::kScanSums), shaders),
      commandsProgram_(programSource(ProgramId::kFaceCommands), shaders),
      slicesProgram_(programSource(ProgramId::kSliceFaces), shaders),
      bytes_(faces.nodes.size() * sizeof(gpu::FaceNode) + faces.lods.size() * sizeof(gpu::FaceLod) +
             faces.units.size() * sizeof(gpu::FaceUnit)),
      view_(sizeof(gpu::FaceView), GL_DYNAMIC_STORAGE_BIT, "view of back faces"),
      nodes_(uploadStorage(faces.nodes, "groups of triangles")),
      lods_(uploadStorage(faces.lods, "levels of groups")),
      units_(uploadStorage(faces.units, "objects of groups")) {}

void FacePass::cull(const DrawList& list, const FaceWork& work, gpu::FaceView values, const gl::Buffer& transforms,
                    const gl::Buffer& view) {
  const std::uint32_t capacity = work.view_.capacity;
  if (capacity == 0) return;
  JAL_CHECK(values.mostRanges <= work.ranges_);
  view_.writeValue(values);
  const auto run = [](const gl::Program& program, std::uint32_t groups) {
    program.use();
    dispatchGroups(groups);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  view.bindUniform(gpu::kBindingCullView);
  work.viewBuffer_.bindUniform(gpu::kBindingListView);
  view_.bindUniform(gpu::kBindingFaceView);
  transforms.bindStorage(gpu::kBindingTransforms);
  list.slots().bindStorage(gpu::kBindingSlots);
  units_.bindStorage(gpu::kBindingFaceUnits);
  lods_.bindStorage(gpu::kBindingFaceLods);
  list.instances().bindStorage(gpu::kBindingInstances);
  list.drawCounts().bindStorage(gpu::kBindingFaceCounts);
  nodes_.bindStorage(gpu::kBindingFaceNodes);
  work.words_.bindStorage(gpu::kBindingFaceWork);
  run(rangesProgram_, objectGroups(capacity));
  work.blockSums_.bindStorage(gpu::kBindingBlockSums);
  run(scanEntriesProgram_, (work.view_.entryCount + gpu::kScanBlock - 1) / gpu::kScanBlock);
  run(scanSumsProgram_, 1);
  list.faceFigures().bindStorage(gpu::kBindingFaceFigures);
  list.drawCounts().bindStorage(gpu::kBindingDrawCounts);
  list.commands().bindStorage(gpu::kBindingCommands);
  run(commandsProgram_, objectGroups(capacity));
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void FacePass::cullSlices(const FaceSlices& slices, gpu::uint test, const gl::Buffer& transforms,
                          const ObjectBuffers& decided) {
  view_.writeValue(gpu::FaceView{test, slices.values.faceCommands - 1, 0, 0});
  decided.view->bindUniform(gpu::kBindingCullView);
  view_.bindUniform(gpu::kBindingFaceView);
  slices.view.bindUniform(gpu::kBindingSliceView);
  transforms.bindStorage(gpu::kBindingTransforms);
  slices.order.bindStorage(gpu::kBindingFaceOrder);
  units_.bindStorage(gpu::kBindingFaceUnits);
  lods_.bindStorage(gpu::kBindingFaceLods);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingFaceMarks);
  nodes_.bindStorage(gpu::kBindingFaceNodes);
  slices.commands.bindStorage(gpu::kBindingCommands);
  slicesProgram_.use();
  dispatchGroups(objectGroups(2 * slices.values.unitCount));
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace jalousie::visibility
