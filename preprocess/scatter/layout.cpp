// Places objects by rejection sampling. It uses only sums, products and square roots, which all machines round alike.
#include "scatter/layout.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/random.h"

namespace jalousie::scatter {
namespace {

/// Uniform direction in Vector::length() dimensions: a point of the unit ball, pushed to its surface.
template <class Vector>
Vector randomDirection(Random& random) {
  for (;;) {
    Vector v(0.0F);
    for (int i = 0; i < Vector::length(); ++i)
      v[i] = random.uniform(-1.0F, 1.0F);
    const float squared = glm::dot(v, v);
    if (squared > 1e-4F && squared <= 1.0F) return v / std::sqrt(squared);
  }
}

/// A uniform direction of the half angle gives a uniform angle, and a uniform unit quaternion a uniform rotation.
glm::quat randomRotation(Rotation kind, Random& random) {
  if (kind == Rotation::kX) {
    const auto half = randomDirection<glm::vec2>(random);
    return {half.x, half.y, 0.0F, 0.0F};
  }
  if (kind == Rotation::kAny) {
    const auto q = randomDirection<glm::vec4>(random);
    return {q.w, q.x, q.y, q.z};
  }
  return {1.0F, 0.0F, 0.0F, 0.0F};
}

glm::vec3 randomPlace(float halfSide, Random& random) {
  glm::vec3 place(0.0F);
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = random.uniform(-halfSide, halfSide);
  return place;
}

/// The first of random places that leaves a city's buildings alone. Streets are always free.
/// @param scale  the object's largest one
glm::vec3 freePlace(const City& city, glm::vec3 place, float scale, Random& random) {
  while (!city.isFree({place.x, place.z}, 0.5F * scale * city.unit))
    place = randomPlace(0.5F * city.side(), random);
  return place;
}

}  // namespace

float sideOf(const Layout& layout, const SourceAsset& source) {
  return layout.side ? *layout.side : layout.sideDiagonals * source.diagonal;
}

float standOnGround(std::vector<Placement>& placements, const SourceAsset& source) {
  const auto depthOf = [&](const Placement& placed) {
    float lowest = std::numeric_limits<float>::infinity();
    for (const SourcePart& part : source.parts) {
      const asset::Instances instances = instancesOf({{glm::vec3(0.0F), placed.turn, placed.factor}}, source, part);
      for (std::size_t i = 0; i < instances.translations.size(); ++i)
        for (const glm::vec3& p : part.outermost)
          lowest = std::min(lowest, (instances.translations[i] + instances.rotations[i] * (instances.scales[i] * p)).y);
    }
    return lowest;
  };
  const float ground = placements.front().place.y + depthOf(placements.front());
  for (Placement& placed : placements)
    placed.place.y = ground - depthOf(placed);
  return ground;
}

std::vector<Placement> placeObjects(const Layout& layout, float side, Progress& progress, const City* city) {
  constexpr std::uint32_t kProgressStep = 1U << 16U;
  Random random(layout.seed);
  std::vector<Placement> placements;
  placements.reserve(layout.count);
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    glm::vec3 place = i == 0 ? glm::vec3(0.0F) : randomPlace(0.5F * side, random);
    if (city != nullptr) place = freePlace(*city, place, layout.scale.max, random);
    if (layout.isOnGround()) place.y = 0.0F;
    const glm::quat turn = randomRotation(layout.rotation, random);
    placements.push_back({place, turn, random.uniform(layout.scale.min, layout.scale.max)});
    if (i % kProgressStep == 0) progress.update(i);
  }
  return placements;
}

asset::Instances instancesOf(const std::vector<Placement>& placements, const SourceAsset& source,
                             const SourcePart& part) {
  const std::size_t count = placements.size() * part.poses.size();
  asset::Instances instances;
  instances.translations.reserve(count);
  instances.rotations.reserve(count);
  instances.scales.reserve(count);
  const bool isSingle = source.isSingle();
  for (const Placement& placed : placements) {
    for (const Pose& pose : part.poses) {
      const glm::quat rotation = placed.turn * pose.rotation;
      const glm::vec3 scale = placed.factor * pose.scale;
      // Both are the same but for rounding. A single mesh keeps the bytes that it always had.
      instances.translations.push_back(
          isSingle ? placed.place - rotation * (scale * part.boxObject.center())
                   : placed.place + placed.turn * (placed.factor * (pose.translation - source.center)));
      instances.rotations.push_back(rotation);
      instances.scales.push_back(scale);
    }
  }
  return instances;
}

Aabb boundsOf(const asset::Instances& instances, const Aabb& boxObject) {
  Aabb bounds;
  for (std::size_t i = 0; i < instances.translations.size(); ++i) {
    const glm::mat4 worldFromObject =
        glm::scale(glm::translate(glm::mat4(1.0F), instances.translations[i]) * glm::mat4_cast(instances.rotations[i]),
                   instances.scales[i]);
    bounds.add(transformed(worldFromObject, boxObject));
  }
  return bounds;
}

}  // namespace jalousie::scatter
