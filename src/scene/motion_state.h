// What animations say at a time, on the CPU.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "scene/motion_data.h"

namespace jalousie::scene {

/// What the nodes of an animation say at a time.
struct MotionState {
  std::vector<float> weights;              ///< of morph targets
  std::vector<gpu::Transform> transforms;  ///< [MotionData::transformCount], of the first targets
  std::vector<gpu::Transform> joints;
};

/// A bent vertex; the normal is not unit.
struct MovedVertex {
  glm::vec3 position;
  glm::vec3 normal;
};

/// GPU twins: shaders/motion/move_nodes.comp, move_targets.comp. @param seconds  before the first key and after the
/// last one of a property, it has their values
MotionState motionAt(const MotionData& motion, float seconds);
/// Box of a bent chain, object space. GPU twin: shaders/motion/bound_poses.comp
Aabb posedBox(const MotionData& motion, const gpu::BentChain& chain, const MotionState& state);
/// GPU twin: shaders/motion/bend_vertices.comp
MovedVertex movedVertex(const MotionData& motion, const gpu::BentVertex& vertex, const MotionState& state);
/// Normal of a vertex as packNormal() makes it. @param number  index into MotionData::vertices
std::uint32_t packedNormalOf(const MotionData& motion, std::size_t number, const MotionState& state);

/// What the objects, points and lines that move reach: looked at 30 times a second, at most 512 times.
/// @param rest  transforms of all objects
Aabb motionBounds(const MotionData& motion, std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                  std::span<const gpu::Transform> rest);

}  // namespace jalousie::scene
