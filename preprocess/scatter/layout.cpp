// Places objects by rejection sampling. It uses only sums, products and square roots, which all machines round alike.
#include "scatter/layout.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

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

}  // namespace

float sideOf(const Layout& layout, const SourceChain& chain) {
  return layout.side ? *layout.side : layout.sideDiagonals * chain.diagonal();
}

asset::Instances placeObjects(const Layout& layout, const SourceChain& chain, Progress& progress) {
  constexpr std::uint32_t kProgressStep = 1U << 16U;
  Random random(layout.seed);
  const float halfSide = 0.5F * sideOf(layout, chain);
  const Pose& pose = chain.worldFromObject;
  asset::Instances instances;
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    const glm::vec3 place = i == 0 ? glm::vec3(0.0F) : randomPlace(halfSide, random);
    const glm::quat turn = randomRotation(layout.rotation, random);
    const float factor = random.uniform(layout.scale.min, layout.scale.max);
    const glm::quat rotation = turn * pose.rotation;
    const glm::vec3 scale = factor * pose.scale;
    instances.translations.push_back(place - rotation * (scale * chain.boxObject.center()));
    instances.rotations.push_back(rotation);
    instances.scales.push_back(scale);
    if (i % kProgressStep == 0) progress.update(i);
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
