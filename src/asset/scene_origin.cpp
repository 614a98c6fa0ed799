// The middle of the scene's box, in double precision, rounded to whole units.
#include "asset/scene_origin.h"

#include <limits>
#include <vector>

#include "core/aabb.h"
#include "core/check.h"

namespace jalousie::asset::detail {
namespace {

constexpr double kFarDiagonals = 16.0;

Aabb boundsOf(const Mesh& mesh) {
  Aabb box;
  for (const Primitive& primitive : mesh.primitives)
    for (const glm::vec3& position : primitive.positions)
      box.add(position);
  return box;
}

/// A box in double precision.
struct Extent {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  glm::dvec3 center() const { return 0.5 * (min + max); }
  /// Also false for an empty box, and for one that is not finite.
  bool isFar() const { return glm::length(center()) > kFarDiagonals * glm::length(max - min); }
};

Extent extentOf(const SceneFile& scene, std::span<const glm::dvec3> places) {
  std::vector<Aabb> boxes;  // of the finest levels
  for (const Chain& chain : scene.chains)
    boxes.push_back(boundsOf(scene.meshes[chain.levels.front().mesh]));
  Extent extent;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Aabb& box = boxes[scene.instances[i].chain];
    const glm::dmat3 axes(glm::mat3(scene.instances[i].worldFromObject));
    const glm::dvec3 middle = places[i] + axes * glm::dvec3(box.center());
    const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
    const glm::dvec3 reach = glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z;
    extent.min = glm::min(extent.min, middle - reach);
    extent.max = glm::max(extent.max, middle + reach);
  }
  return extent;
}

}  // namespace

void placeNearOrigin(SceneFile& scene, std::span<const glm::dvec3> places) {
  JAL_CHECK(places.size() == scene.instances.size());
  const Extent extent = extentOf(scene, places);
  if (places.empty() || !extent.isFar()) return;
  scene.originWorld = glm::round(extent.center());
  for (std::size_t i = 0; i < places.size(); ++i)
    scene.instances[i].worldFromObject[3] = glm::vec4(places[i] - scene.originWorld, 1.0);
  const glm::dvec4 offset(scene.originWorld, 0.0);
  for (Camera& camera : scene.cameras) {
    camera.worldFromCamera[3] -= offset;
    camera.worldFromParent[3] -= offset;
  }
}

}  // namespace jalousie::asset::detail
