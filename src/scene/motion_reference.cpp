// Writes what motion_state.h says into the arrays of a scene.
#include "scene/motion_reference.h"

#include "scene/motion_state.h"

namespace jalousie::scene {
namespace {

void setBounds(gpu::Chain& chain, const Aabb& box) {
  chain.boundsMinObject = glm::vec4(box.min, 0.0F);
  chain.boundsMaxObject = glm::vec4(box.max, 0.0F);
}

}  // namespace

void poseScene(SceneData& scene, float seconds) {
  const MotionData& motion = scene.motion;
  const MotionState state = motionAt(motion, seconds);
  for (std::uint32_t t = 0; t < motion.transformCount; ++t)
    scene.transforms[motion.targets[t].destination] = state.transforms[t];
  for (std::size_t v = 0; v < motion.vertices.size(); ++v) {
    const gpu::BentVertex& vertex = motion.vertices[v];
    const bool isLoose = (vertex.flags & gpu::kBentLoose) != 0;
    Vertex& target =
        isLoose ? scene.loose.vertices[vertex.destination] : scene.vertices[motion.firstVertex + vertex.destination];
    target.position = movedVertex(motion, vertex, state).position;
    target.normal = packedNormalOf(motion, v, state);
  }
  for (const gpu::BentChain& bent : motion.chains) {
    const Aabb box = posedBox(motion, bent, state);
    setBounds(scene.chains[bent.chain], box);
    if (bent.cellChain == gpu::kNoMotion) continue;
    setBounds(scene.cells.chains[bent.cellChain], box);
    for (std::uint32_t lod = 0; lod < bent.cellLodCount; ++lod)
      scene.cells.bounds[bent.firstCellLod + lod] = {glm::vec4(box.min, 0.0F), glm::vec4(box.max, 0.0F)};
  }
}

}  // namespace jalousie::scene
