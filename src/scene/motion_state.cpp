// Keys, products of matrices, bent vertices and boxes, one after another.
#include "scene/motion_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/camera.h"
#include "scene/transform.h"
#include "scene/vertex.h"

namespace jalousie::scene {
namespace {

using gpu::Transform;

constexpr std::size_t kMostSamples = 512;
/// Points and lines are looked at in one of so many samples.
constexpr std::size_t kLooseInterval = 16;

/// The keys around the time.
struct KeysAround {
  std::uint32_t first;
  std::uint32_t second;
  float share;   ///< of the second, 0 to 1
  float length;  ///< seconds between them; 0 where first is second
};

/// Values of tracks at one time.
class Keys {
 public:
  Keys(const MotionData& motion, float seconds) : motion_(motion), seconds_(seconds) {}

  float component(std::uint32_t index, std::uint32_t component) const {
    const gpu::MotionTrack& track = motion_.tracks[index];
    return componentAt(track, find(track), component);
  }

  glm::vec3 vector(std::uint32_t index, const glm::vec4& rest) const {
    if (index == gpu::kNoMotion) return glm::vec3(rest);
    return {component(index, 0), component(index, 1), component(index, 2)};
  }

  glm::vec4 rotation(std::uint32_t index, const glm::vec4& rest) const {
    if (index == gpu::kNoMotion) return rest;
    const gpu::MotionTrack& track = motion_.tracks[index];
    const KeysAround span = find(track);
    if (track.interpolation == gpu::kMotionLinear && span.first != span.second)
      return slerp(keyRotation(track, span.first), keyRotation(track, span.second), span.share);
    return glm::normalize(
        glm::vec4(component(index, 0), component(index, 1), component(index, 2), component(index, 3)));
  }

 private:
  KeysAround find(const gpu::MotionTrack& track) const {
    const auto first = motion_.numbers.begin() + track.firstTime;
    const auto low = static_cast<std::uint32_t>(std::upper_bound(first, first + track.keyCount, seconds_) - first);
    if (low == 0) return {0, 0, 0.0F, 0.0F};
    if (low == track.keyCount) return {low - 1, low - 1, 0.0F, 0.0F};
    const float start = *(first + low - 1);
    const float span = *(first + low) - start;
    return {low - 1, low, span > 0.0F ? (seconds_ - start) / span : 0.0F, span};
  }

  float number(const gpu::MotionTrack& track, std::uint32_t key, std::uint32_t part, std::uint32_t component) const {
    const std::uint32_t value = track.interpolation == gpu::kMotionCubic ? 3 * key + part : key;
    return motion_.numbers[track.firstValue + value * track.width + component];
  }

  float componentAt(const gpu::MotionTrack& track, const KeysAround& span, std::uint32_t component) const {
    const float value = number(track, span.first, 1, component);
    if (span.first == span.second || track.interpolation == gpu::kMotionStep) return value;
    const float next = number(track, span.second, 1, component);
    const float t = span.share;
    if (track.interpolation == gpu::kMotionLinear) return value + (next - value) * t;
    const float t2 = t * t;
    const float t3 = t2 * t;
    const float leaving = number(track, span.first, 2, component);
    const float arriving = number(track, span.second, 0, component);
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * value + span.length * (t3 - 2.0F * t2 + t) * leaving +
           (3.0F * t2 - 2.0F * t3) * next + span.length * (t3 - t2) * arriving;
  }

  glm::vec4 keyRotation(const gpu::MotionTrack& track, std::uint32_t key) const {
    return glm::normalize(glm::vec4(number(track, key, 1, 0), number(track, key, 1, 1), number(track, key, 1, 2),
                                    number(track, key, 1, 3)));
  }

  static glm::vec4 slerp(const glm::vec4& a, glm::vec4 b, float t) {
    float cosine = glm::dot(a, b);
    if (cosine < 0.0F) {
      b = -b;
      cosine = -cosine;
    }
    if (cosine > 0.9995F) return glm::normalize(glm::mix(a, b, t));
    const float angle = std::acos(cosine);
    return glm::normalize((std::sin((1.0F - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle));
  }

  const MotionData& motion_;
  float seconds_;
};

/// translation * rotation * scale.
Transform transformOf(const glm::vec3& t, const glm::vec4& q, const glm::vec3& s) {
  return {{s.x * (1.0F - 2.0F * (q.y * q.y + q.z * q.z)), s.y * 2.0F * (q.x * q.y - q.w * q.z),
           s.z * 2.0F * (q.x * q.z + q.w * q.y), t.x},
          {s.x * 2.0F * (q.x * q.y + q.w * q.z), s.y * (1.0F - 2.0F * (q.x * q.x + q.z * q.z)),
           s.z * 2.0F * (q.y * q.z - q.w * q.x), t.y},
          {s.x * 2.0F * (q.x * q.z - q.w * q.y), s.y * 2.0F * (q.y * q.z + q.w * q.x),
           s.z * (1.0F - 2.0F * (q.x * q.x + q.y * q.y)), t.z}};
}

Transform product(const Transform& a, const Transform& b) {
  const auto row = [&](const glm::vec4& r) {
    return r.x * b.worldFromObject0 + r.y * b.worldFromObject1 + r.z * b.worldFromObject2 +
           glm::vec4(0.0F, 0.0F, 0.0F, r.w);
  };
  return {row(a.worldFromObject0), row(a.worldFromObject1), row(a.worldFromObject2)};
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
  const float length = glm::length(v);
  return length > 0.0F && std::isfinite(length) ? v / length : fallback;
}

Aabb scaled(const Aabb& box, float factor) {
  const glm::vec3 a = factor * box.min;
  const glm::vec3 b = factor * box.max;
  return {glm::min(a, b), glm::max(a, b)};
}

/// One row of the box of a transformed box, widened by the rounding of a vertex in it.
void setRow(const glm::vec4& row, const Aabb& box, int axis, Aabb& result) {
  const glm::vec3 a = glm::vec3(row) * box.min;
  const glm::vec3 b = glm::vec3(row) * box.max;
  const glm::vec3 least = glm::min(a, b);
  const glm::vec3 most = glm::max(a, b);
  const glm::vec3 size = glm::max(glm::abs(a), glm::abs(b));
  const float rounding = gpu::kBentRounding * (size.x + size.y + size.z + std::abs(row.w));
  result.min[axis] = least.x + least.y + least.z + row.w - rounding;
  result.max[axis] = most.x + most.y + most.z + row.w + rounding;
}

Aabb posed(const MotionData& motion, const gpu::BentBox& entry, const MotionState& state) {
  Aabb box{glm::vec3(entry.minObject), glm::vec3(entry.maxObject)};
  glm::vec3 size = glm::max(glm::abs(box.min), glm::abs(box.max));
  for (std::uint32_t t = 0; t < entry.targetCount; ++t) {
    const gpu::CellBounds& delta = motion.deltaBoxes[entry.firstDelta + t];
    const Aabb part =
        scaled({glm::vec3(delta.minObject), glm::vec3(delta.maxObject)}, state.weights[entry.firstWeight + t]);
    box = {box.min + part.min, box.max + part.max};
    size += glm::max(glm::abs(part.min), glm::abs(part.max));
  }
  box = {box.min - gpu::kBentRounding * size, box.max + gpu::kBentRounding * size};
  if (entry.joint == gpu::kNoMotion) return box;
  const Transform& joint = state.joints[entry.joint];
  Aabb result;
  setRow(joint.worldFromObject0, box, 0, result);
  setRow(joint.worldFromObject1, box, 1, result);
  setRow(joint.worldFromObject2, box, 2, result);
  return result;
}

/// Bound of the factor by which lengths grow.
float scaleOf(const gpu::BentBox& entry, const MotionState& state) {
  if (entry.joint == gpu::kNoMotion) return 1.0F;
  const glm::mat3 linear(worldFromObject(state.joints[entry.joint]));
  return std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) + glm::dot(linear[2], linear[2]));
}

/// Objects whose boxes depend on the time.
std::vector<std::uint32_t> movingObjects(const MotionData& motion, std::span<const gpu::Object> objects,
                                         std::size_t chains, std::size_t transforms) {
  std::vector<bool> moves(transforms, false);
  for (std::uint32_t t = 0; t < motion.transformCount; ++t)
    moves[motion.targets[t].destination] = true;
  std::vector<bool> bends(chains, false);
  for (const gpu::BentChain& bent : motion.chains)
    bends[bent.chain] = true;
  std::vector<std::uint32_t> result;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
    if (moves[objects[object].transform] || bends[objects[object].chain]) result.push_back(object);
  return result;
}

}  // namespace

MotionState motionAt(const MotionData& motion, float seconds) {
  const Keys keys(motion, seconds);
  MotionState state;
  for (const gpu::MotionWeight& weight : motion.weights)
    state.weights.push_back(weight.track == gpu::kNoMotion ? weight.rest
                                                           : keys.component(weight.track, weight.component));
  std::vector<Transform> locals;
  for (const gpu::MotionNode& node : motion.nodes) {
    const Transform own =
        transformOf(keys.vector(node.translationTrack, node.translation),
                    keys.rotation(node.rotationTrack, node.rotation), keys.vector(node.scaleTrack, node.scale));
    locals.push_back(product({node.anchorFromParent0, node.anchorFromParent1, node.anchorFromParent2}, own));
  }
  for (std::size_t t = 0; t < motion.targets.size(); ++t) {
    const gpu::MotionTarget& target = motion.targets[t];
    Transform world{target.nodeFromTarget0, target.nodeFromTarget1, target.nodeFromTarget2};
    for (std::uint32_t node = target.node; node != gpu::kNoMotion; node = motion.nodes[node].anchor)
      world = product(locals[node], world);
    (t < motion.transformCount ? state.transforms : state.joints).push_back(world);
  }
  return state;
}

Aabb posedBox(const MotionData& motion, const gpu::BentChain& chain, const MotionState& state) {
  Aabb box;
  float scale = 0.0F;
  for (std::uint32_t i = 0; i < chain.boxCount; ++i) {
    box.add(posed(motion, motion.boxes[chain.firstBox + i], state));
    scale = std::max(scale, scaleOf(motion.boxes[chain.firstBox + i], state));
  }
  // An edge is as long as its joints make it, and longer where its ends follow different joints.
  const float bulge = chain.bulge * (scale * chain.longestEdge + chain.weightStep * glm::length(box.max - box.min));
  Aabb result = scaled(box, chain.leastSum);
  result.add(scaled(box, chain.mostSum));
  return {result.min - bulge, result.max + bulge};
}

MovedVertex movedVertex(const MotionData& motion, const gpu::BentVertex& vertex, const MotionState& state) {
  MovedVertex result{glm::vec3(vertex.position), glm::vec3(vertex.normal)};
  for (std::uint32_t t = 0; t < vertex.targetCount; ++t) {
    const float weight = state.weights[vertex.firstWeight + t];
    if (weight == 0.0F) continue;
    const gpu::MorphDelta& delta = motion.deltas[vertex.firstDelta + t * vertex.deltaStride];
    result.position += weight * glm::vec3(delta.position);
    result.normal += weight * glm::vec3(delta.normal);
  }
  if ((vertex.flags & gpu::kBentSkinned) == 0) return result;
  glm::mat4 blended(0.0F);
  for (std::uint32_t i = 0; i < vertex.influenceCount; ++i) {
    const gpu::Influence& influence = motion.influences[vertex.firstInfluence + i];
    blended += influence.weight * worldFromObject(state.joints[influence.joint]);
  }
  const glm::mat3 linear(blended);
  glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                      glm::cross(linear[0], linear[1]));
  if (glm::determinant(linear) < 0.0F) cofactors = -cofactors;
  return {glm::vec3(blended * glm::vec4(result.position, 1.0F)), cofactors * result.normal};
}

std::uint32_t packedNormalOf(const MotionData& motion, std::size_t number, const MotionState& state) {
  const gpu::BentVertex& vertex = motion.vertices[number];
  glm::vec3 normal = movedVertex(motion, vertex, state).normal;
  if ((vertex.flags & gpu::kBentLoose) != 0) return packNormal(unitOr(normal, glm::vec3(0.0F)));
  if ((vertex.flags & gpu::kBentFlat) != 0) {
    const std::size_t first = number - (vertex.flags >> gpu::kBentCornerShift & 3U);
    const auto corner = [&](std::size_t k) { return movedVertex(motion, motion.vertices[first + k], state).position; };
    normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  }
  return packNormal(unitOr(normal, glm::vec3(0.0F, 0.0F, 1.0F)));
}

Aabb motionBounds(const MotionData& motion, std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                  std::span<const gpu::Transform> rest) {
  std::vector<Aabb> boxes;
  for (const gpu::Chain& chain : chains)
    boxes.push_back({glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
  std::vector<Transform> transforms(rest.begin(), rest.end());
  const std::vector<std::uint32_t> moving = movingObjects(motion, objects, chains.size(), rest.size());
  const auto samples =
      std::min(static_cast<std::size_t>(std::ceil(static_cast<double>(motion.lastKey) * kPathRate)), kMostSamples - 1);
  Aabb bounds;
  for (std::size_t i = 0; i <= samples; ++i) {
    const float share = samples > 0 ? static_cast<float>(i) / static_cast<float>(samples) : 0.0F;
    const MotionState state = motionAt(motion, share * motion.lastKey);
    for (std::uint32_t t = 0; t < motion.transformCount; ++t)
      transforms[motion.targets[t].destination] = state.transforms[t];
    for (const gpu::BentChain& bent : motion.chains)
      boxes[bent.chain] = posedBox(motion, bent, state);
    for (const std::uint32_t object : moving)
      bounds.add(transformed(worldFromObject(transforms[objects[object].transform]), boxes[objects[object].chain]));
    if (i % kLooseInterval != 0 && i != samples) continue;
    for (const gpu::BentVertex& vertex : motion.vertices)
      if ((vertex.flags & gpu::kBentLoose) != 0) bounds.add(movedVertex(motion, vertex, state).position);
  }
  return bounds;
}

}  // namespace jalousie::scene
