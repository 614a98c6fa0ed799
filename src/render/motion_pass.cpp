// nodes -> targets -> vertices and boxes.
#include "render/motion_pass.h"

#include <algorithm>
#include <vector>

#include "render/program_table.h"
#include "visibility/dispatch.h"
#include "visibility/storage.h"

namespace jalousie::render {
namespace {

using visibility::dispatchGroups;
using visibility::objectGroups;
using visibility::uploadStorage;

template <class T>
gl::Buffer room(std::size_t elements, const char* name) {
  return visibility::makeStorage(elements * sizeof(T), 0, name);
}

template <class T>
std::uint32_t count(const std::vector<T>& elements) {
  return static_cast<std::uint32_t>(elements.size());
}

}  // namespace

MotionPass::MotionPass(const scene::MotionData& motion, const gl::ShaderLibrary& shaders)
    : view_{.seconds = 0.0F,
            .nodeCount = count(motion.nodes),
            .weightCount = count(motion.weights),
            .transformCount = motion.transformCount,
            .targetCount = count(motion.targets),
            .vertexCount = count(motion.vertices),
            .chainCount = count(motion.chains),
            .reserved0 = 0},
      firstVertexByte_(std::size_t{motion.firstVertex} * sizeof(scene::Vertex)),
      vertexBytes_(std::size_t{motion.vertexEnd - motion.firstVertex} * sizeof(scene::Vertex)),
      moveNodes_(programSource(ProgramId::kMoveNodes), shaders),
      moveTargets_(programSource(ProgramId::kMoveTargets), shaders),
      bendVertices_(programSource(ProgramId::kBendVertices), shaders),
      boundPoses_(programSource(ProgramId::kBoundPoses), shaders),
      viewBuffer_(sizeof(gpu::MotionView), GL_DYNAMIC_STORAGE_BIT, "motion view"),
      numbers_(uploadStorage(motion.numbers, "animation keys")),
      tracks_(uploadStorage(motion.tracks, "animation tracks")),
      nodes_(uploadStorage(motion.nodes, "animated nodes")),
      weightTable_(uploadStorage(motion.weights, "animated weights")),
      targets_(uploadStorage(motion.targets, "animation targets")),
      vertices_(uploadStorage(motion.vertices, "bent vertices")),
      influences_(uploadStorage(motion.influences, "influences of joints")),
      deltas_(uploadStorage(motion.deltas, "morph targets")),
      chains_(uploadStorage(motion.chains, "bent chains")),
      boxes_(uploadStorage(motion.boxes, "boxes of joints")),
      deltaBoxes_(uploadStorage(motion.deltaBoxes, "boxes of morph targets")),
      locals_(room<gpu::Transform>(motion.nodes.size(), "transforms of animated nodes")),
      weights_(room<float>(motion.weights.size(), "weights of morph targets")),
      joints_(room<gpu::Transform>(motion.jointCount(), "joints")) {
  visibility::checkStorage(vertexBytes_, "animated vertices");
}

void MotionPass::play(float seconds, SceneBuffers& scene) {
  if (view_.targetCount == 0 && view_.vertexCount == 0) return;
  if (played_ == seconds) return;
  played_ = seconds;
  scene.noteMovement();
  view_.seconds = seconds;
  viewBuffer_.writeValue(view_);
  viewBuffer_.bindUniform(gpu::kBindingMotionView);
  weights_.bindStorage(gpu::kBindingWeights);
  joints_.bindStorage(gpu::kBindingJoints);
  moveNodes();
  moveTargets(scene);
  bendVertices(scene);
  boundPoses(scene);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void MotionPass::moveNodes() {
  moveNodes_.use();
  nodes_.bindStorage(gpu::kBindingMotionNodes);
  tracks_.bindStorage(gpu::kBindingMotionTracks);
  numbers_.bindStorage(gpu::kBindingMotionNumbers);
  locals_.bindStorage(gpu::kBindingMotionLocals);
  weightTable_.bindStorage(gpu::kBindingMotionWeights);
  dispatchGroups(objectGroups(view_.nodeCount + view_.weightCount));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void MotionPass::moveTargets(SceneBuffers& scene) {
  moveTargets_.use();
  targets_.bindStorage(gpu::kBindingMotionTargets);
  scene.transforms().bindStorage(gpu::kBindingMovedTransforms);
  dispatchGroups(objectGroups(view_.targetCount));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void MotionPass::bendVertices(const SceneBuffers& scene) {
  if (view_.vertexCount == 0) return;
  bendVertices_.use();
  if (vertexBytes_ > 0)
    scene.vertices().bindStorageRange(gpu::kBindingVertices, firstVertexByte_, vertexBytes_);
  else
    scene.looseVertices().bindStorage(gpu::kBindingVertices);
  scene.looseVertices().bindStorage(gpu::kBindingLooseVertices);
  vertices_.bindStorage(gpu::kBindingBentVertices);
  influences_.bindStorage(gpu::kBindingInfluences);
  deltas_.bindStorage(gpu::kBindingDeltas);
  dispatchGroups(objectGroups(view_.vertexCount));
}

void MotionPass::boundPoses(const SceneBuffers& scene) {
  if (view_.chainCount == 0) return;
  boundPoses_.use();
  scene.chains().bindStorage(gpu::kBindingMovedChains);
  scene.cellChains().bindStorage(gpu::kBindingMovedCellChains);
  scene.cellBounds().bindStorage(gpu::kBindingMovedCellBounds);
  boxes_.bindStorage(gpu::kBindingBentBoxes);
  chains_.bindStorage(gpu::kBindingBentChains);
  deltaBoxes_.bindStorage(gpu::kBindingDeltaBoxes);
  dispatchGroups(view_.chainCount);
}

}  // namespace jalousie::render
