// Dispatches over places; nothing is allocated after allocate().
#include "render/slice_pass.h"

#include "core/check.h"
#include "visibility/dispatch.h"
#include "visibility/program_table.h"
#include "visibility/storage.h"

namespace jalousie::render {
namespace {

gl::Buffer words(std::size_t count, GLbitfield flags, const char* name) {
  return visibility::makeStorage(count * sizeof(gpu::uint), flags, name);
}

template <class T>
void fill(gl::Buffer& buffer, std::span<const T> elements) {
  if (!elements.empty()) buffer.write(0, std::as_bytes(elements));
}

}  // namespace

std::uint32_t sliceRanges(std::uint32_t mostGroups, std::uint32_t units) {
  return visibility::faceRanges(mostGroups, std::uint64_t{2} * units, visibility::kMostSliceCommands);
}

void SliceOrder::follow(const scene::SceneData& scene, const culling::SpatialHierarchy& tree) {
  objects = tree.objects;
  leafOf.resize(tree.objects.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const culling::HierarchyNode& node = tree.nodes[n];
    for (std::uint32_t i = 0; tree.isLeaf(n) && i < node.objectCount; ++i)
      leafOf[node.firstObject + i] = n;
  }
  // A counting sort of the units by the place of their object.
  const std::vector<gpu::Object>& drawn = scene.drawn().objects;
  placeOf.resize(tree.objects.size());
  for (std::uint32_t place = 0; place < tree.objects.size(); ++place)
    placeOf[tree.objects[place]] = place;
  // While units are put in, an entry is the next free place of the object before it.
  firstUnit.assign(tree.objects.size() + 2, 0);
  for (const gpu::Object& unit : drawn)
    ++firstUnit[placeOf[unit.object] + 2];
  for (std::size_t place = 0; place < tree.objects.size(); ++place)
    firstUnit[place + 2] += firstUnit[place + 1];
  units.resize(drawn.size());
  for (std::uint32_t unit = 0; unit < drawn.size(); ++unit)
    units[firstUnit[placeOf[drawn[unit].object] + 1]++] = unit;
  firstUnit.pop_back();
}

SlicePass::SlicePass(const gl::ShaderLibrary& shaders)
    : sliceCommands_(visibility::programSource(visibility::ProgramId::kSliceCommands), shaders),
      dropHidden_(visibility::programSource(visibility::ProgramId::kDropHidden), shaders),
      hideObjects_(visibility::programSource(visibility::ProgramId::kHideObjects), shaders),
      hideCells_(visibility::programSource(visibility::ProgramId::kHideCells), shaders) {}

void SlicePass::allocate(const scene::SceneData& scene, std::uint32_t nodes) {
  patches_ = scene.maxPatchTriangles > 0;
  cellCount_ = static_cast<std::uint32_t>(scene.cells.objects.size());
  view_.objectCount = static_cast<gpu::uint>(scene.objects.size());
  view_.unitCount = static_cast<gpu::uint>(scene.drawn().objects.size());
  view_.commandCapacity = 2 * view_.unitCount;
  view_.listCount = patches_ ? gpu::kListCount : gpu::kListsPerDetail;
  viewBuffer_ = gl::Buffer(sizeof(gpu::SliceView), GL_DYNAMIC_STORAGE_BIT, "slice view");
  objectOrder_ = words(view_.objectCount, GL_DYNAMIC_STORAGE_BIT, "order of objects");
  unitOrder_ = words(view_.unitCount, GL_DYNAMIC_STORAGE_BIT, "order of slices");
  leafOf_ = words(view_.objectCount, GL_DYNAMIC_STORAGE_BIT, "leaves of objects");
  commands_ = visibility::makeStorage(std::size_t{view_.listCount} * view_.commandCapacity * sizeof(gpu::DrawCommand),
                                      0, "commands of slices");
  faceRanges_ = sliceRanges(scene.faces.mostGroups, view_.unitCount);
  if (faceRanges_ > 0)
    faceCommands_ =
        visibility::makeStorage(std::size_t{2} * view_.commandCapacity * (faceRanges_ + 1) * sizeof(gpu::DrawCommand),
                                0, "commands of slices without back faces");
  instances_ = words(view_.commandCapacity, 0, "instances of slices");
  samples_ = words(nodes, 0, "samples of queries");
  ranges_ = visibility::makeStorage(kMostRanges * sizeof(gpu::SliceRange), GL_DYNAMIC_STORAGE_BIT, "ranges of slices");
  drawnBits_ = words((view_.objectCount + 31) / 32, GL_DYNAMIC_STORAGE_BIT, "drawn objects");
}

void SlicePass::setOrder(const SliceOrder& order) {
  JAL_CHECK(order.objects.size() == view_.objectCount);
  JAL_CHECK(order.units.size() == view_.unitCount);
  fill<gpu::uint>(objectOrder_, order.objects);
  fill<gpu::uint>(unitOrder_, order.units);
  fill<gpu::uint>(leafOf_, order.leafOf);
}

void SlicePass::prepare(const culling::QueryOptions& options) {
  view_.threshold = options.threshold;
  view_.importance = options.importance;
  viewBuffer_.writeValue(view_);
  if (samplesWritten_) {
    const gpu::uint unknown = gpu::kSamplesUnknown;
    glClearNamedBufferData(samples_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &unknown);
    samplesWritten_ = false;
  }
}

void SlicePass::begin(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
                      const culling::QueryOptions& options, const SliceFaces& faces) {
  view_.faceCommands = faces.pass != nullptr && faceRanges_ > 0 ? faceRanges_ + 1 : 0;
  prepare(options);
  const visibility::SceneBindings drawn = scene.drawn();
  const visibility::ObjectBuffers units = decided.drawn();
  units.view->bindUniform(gpu::kBindingCullView);
  viewBuffer_.bindUniform(gpu::kBindingSliceView);
  unitOrder_.bindStorage(gpu::kBindingOrder);
  drawn.objects->bindStorage(gpu::kBindingObjects);
  drawn.chains->bindStorage(gpu::kBindingChains);
  drawn.lods->bindStorage(gpu::kBindingLods);
  units.states->bindStorage(gpu::kBindingStates);
  units.marks->bindStorage(gpu::kBindingMarks);
  commands_.bindStorage(gpu::kBindingCommands);
  instances_.bindStorage(gpu::kBindingSliceInstances);
  sliceCommands_.use();
  visibility::dispatchGroups(visibility::objectGroups(view_.unitCount));
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  if (view_.faceCommands > 0)
    faces.pass->cullSlices({faceCommands_, viewBuffer_, unitOrder_, view_}, faces.test, *scene.transforms, units);
}

void SlicePass::dropHidden(std::span<const gpu::SliceRange> ranges) {
  JAL_CHECK(ranges.size() <= kMostRanges);
  if (ranges.empty()) return;
  ranges_.write(0, std::as_bytes(ranges));
  glMemoryBarrier(GL_QUERY_BUFFER_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  viewBuffer_.bindUniform(gpu::kBindingSliceView);
  ranges_.bindStorage(gpu::kBindingRanges);
  samples_.bindStorage(gpu::kBindingSamples);
  commands().bindStorage(gpu::kBindingCommands);
  dropHidden_.use();
  visibility::dispatchGroups(static_cast<std::uint32_t>(ranges.size()));
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void SlicePass::hideKnown(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
                          std::span<const std::uint32_t> notHidden) {
  prepare({});
  hide(scene, decided, notHidden);
}

void SlicePass::hide(const visibility::SceneBindings& scene, const visibility::ObjectBuffers& decided,
                     std::span<const std::uint32_t> drawn) {
  if (view_.objectCount == 0) return;
  fill<std::uint32_t>(drawnBits_, drawn);
  glMemoryBarrier(GL_QUERY_BUFFER_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  viewBuffer_.bindUniform(gpu::kBindingSliceView);
  decided.view->bindUniform(gpu::kBindingCullView);
  objectOrder_.bindStorage(gpu::kBindingOrder);
  drawnBits_.bindStorage(gpu::kBindingDrawnBits);
  leafOf_.bindStorage(gpu::kBindingLeafOf);
  samples_.bindStorage(gpu::kBindingSamples);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingMarks);
  hideObjects_.use();
  visibility::dispatchGroups(visibility::objectGroups(view_.objectCount));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (cellCount_ == 0) return;
  scene.cells->bindStorage(gpu::kBindingObjects);
  decided.cellStates->bindStorage(gpu::kBindingCellStates);
  decided.cellMarks->bindStorage(gpu::kBindingCellMarks);
  hideCells_.use();
  visibility::dispatchGroups(visibility::objectGroups(cellCount_));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace jalousie::render
