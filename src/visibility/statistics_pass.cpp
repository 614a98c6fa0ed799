// Ring of statistics: a slot holds the counters, then the draw counts of both lists.
#include "visibility/statistics_pass.h"

#include <algorithm>
#include <cstring>

#include "policy/traits.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {
namespace {

constexpr std::size_t kWords = gpu::kCounterCount + 2 * gpu::kDrawCounts + 2 * gpu::kFaceFigures;
constexpr std::size_t kSlotBytes = 512;
static_assert(kWords * sizeof(gpu::uint) <= kSlotBytes);
static_assert(gpu::kCounterCount <= gpu::kObjectGroupSize, "one thread of the kernel adds up each counter");
static_assert(gpu::kCounterVerdicts + gpu::kVerdictCount <= gpu::kCounterLevels);
static_assert(gpu::kMaxTessellationLevel <= gpu::kMaxLods);
constexpr GLbitfield kMapFlags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT;

}  // namespace

StatisticsPass::StatisticsPass(const gl::ShaderLibrary& shaders)
    : countProgram_(programSource(ProgramId::kCountStates), shaders),
      countCellsProgram_(programSource(ProgramId::kCountCells), shaders),
      countStatesOfCellsProgram_(programSource(ProgramId::kCountStatesOfCells), shaders),
      counters_(sizeof(FrameCounters), 0, "frame counters"),
      mapped_(3 * kSlotBytes, kMapFlags | GL_CLIENT_STORAGE_BIT, "statistics ring"),
      memory_(static_cast<const gpu::uint*>(glMapNamedBufferRange(mapped_.id(), 0, 3 * kSlotBytes, kMapFlags))) {}

StatisticsPass::~StatisticsPass() {
  for (const Slot& slot : slots_)
    if (slot.fence != nullptr) glDeleteSync(slot.fence);
  glUnmapNamedBuffer(mapped_.id());
}

void StatisticsPass::endFrame(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                              const DrawList* early, const DrawList& late) {
  ++frame_;
  const std::size_t index = frame_ % slots_.size();
  Slot& slot = slots_[index];
  const bool hasRoom = slot.fence == nullptr || collect(slot, index, 0);
  if (!hasRoom) return;
  count(scene, decided, view, early, late);
  auto offset = static_cast<GLintptr>(index * kSlotBytes);
  const auto copy = [&](const gl::Buffer& buffer, std::size_t words) {
    const auto bytes = static_cast<GLsizeiptr>(words * sizeof(gpu::uint));
    glCopyNamedBufferSubData(buffer.id(), mapped_.id(), 0, offset, bytes);
    offset += bytes;
  };
  const DrawList& first = early != nullptr ? *early : late;
  copy(counters_, gpu::kCounterCount);
  copy(first.drawCounts(), gpu::kDrawCounts);
  copy(late.drawCounts(), gpu::kDrawCounts);
  copy(first.faceFigures(), gpu::kFaceFigures);
  copy(late.faceFigures(), gpu::kFaceFigures);
  glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
  slot.frame = frame_;
  slot.view = view;
  slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void StatisticsPass::count(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                           const DrawList* early, const DrawList& late) {
  if (view.objectCount == 0) return;
  counters_.clear();
  decided.view->bindUniform(gpu::kBindingCullView);
  counters_.bindStorage(gpu::kBindingCounters);
  if (view.cellCount > 0) {
    if (early != nullptr && has(view.traits, gpu::kTraitTwoPhases)) countCells(scene, decided, view, *early);
    countCells(scene, decided, view, late);
  }
  (view.cellCount > 0 ? countStatesOfCellsProgram_ : countProgram_).use();
  scene.objects->bindStorage(gpu::kBindingObjects);
  scene.chains->bindStorage(gpu::kBindingChains);
  scene.lods->bindStorage(gpu::kBindingLods);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingMarks);
  (early != nullptr ? *early : late).slots().bindStorage(gpu::kBindingEarlySlots);
  late.slots().bindStorage(gpu::kBindingLateSlots);
  dispatchGroups(objectGroups(view.objectCount));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void StatisticsPass::countCells(const SceneBindings& scene, const ObjectBuffers& decided, const gpu::CullView& view,
                                const DrawList& list) const {
  countCellsProgram_.use();
  list.bindView(gpu::kBindingListView);
  scene.cells->bindStorage(gpu::kBindingObjects);
  scene.cellChains->bindStorage(gpu::kBindingChains);
  scene.cellLods->bindStorage(gpu::kBindingLods);
  decided.cellStates->bindStorage(gpu::kBindingStates);
  decided.cellMarks->bindStorage(gpu::kBindingMarks);
  list.slots().bindStorage(gpu::kBindingSlotsOfList);
  decided.marks->bindStorage(gpu::kBindingObjectMarks);
  dispatchGroups(objectGroups(view.cellCount));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

bool StatisticsPass::collect(Slot& slot, std::size_t index, std::uint64_t timeoutNs) {
  const GLenum status = glClientWaitSync(slot.fence, GL_SYNC_FLUSH_COMMANDS_BIT, timeoutNs);
  if (status != GL_ALREADY_SIGNALED && status != GL_CONDITION_SATISFIED) return false;
  glDeleteSync(slot.fence);
  slot.fence = nullptr;
  if (latest_ && latest_->frame > slot.frame) return true;
  FrameRecord record;
  record.frame = slot.frame;
  record.view = slot.view;
  const gpu::uint* words = memory_ + index * kSlotBytes / sizeof(gpu::uint);
  const auto read = [&](auto& values) {
    std::copy_n(words, values.size(), values.begin());
    words += values.size();
  };
  read(record.counters);
  read(record.early);
  read(record.late);
  read(record.earlyFaces);
  read(record.lateFaces);
  latest_ = record;
  return true;
}

const std::optional<FrameRecord>& StatisticsPass::latest() {
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].fence != nullptr) collect(slots_[i], i, 0);
  return latest_;
}

const std::optional<FrameRecord>& StatisticsPass::finish() {
  for (std::size_t i = 0; i < slots_.size(); ++i)
    while (slots_[i].fence != nullptr && !collect(slots_[i], i, 1000000000ULL)) {
    }
  return latest_;
}

}  // namespace jalousie::visibility
