// The middle of the scene's box, in double precision, rounded to whole units.
#include "asset/scene_origin.h"

#include <algorithm>
#include <functional>
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

Aabb boundsOf(const LooseGeometry& geometry) {
  Aabb box;
  for (const std::vector<LooseVertex>& vertices : {std::cref(geometry.points), std::cref(geometry.lines)})
    for (const LooseVertex& vertex : vertices)
      box.add(vertex.position);
  return box;
}

/// A box in double precision.
struct Extent {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  /// @param place  the origin of worldFromObject
  void add(const Aabb& box, const glm::mat4& worldFromObject, const glm::dvec3& place) {
    const glm::dmat3 axes{glm::mat3(worldFromObject)};
    const glm::dvec3 middle = place + axes * glm::dvec3(box.center());
    const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
    const glm::dvec3 reach = glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z;
    min = glm::min(min, middle - reach);
    max = glm::max(max, middle + reach);
  }
  glm::dvec3 center() const { return 0.5 * (min + max); }
  /// Also false for an empty box, and for one that is not finite.
  bool isFar() const { return glm::length(center()) > kFarDiagonals * glm::length(max - min); }
};

Extent extentOf(const SceneFile& scene, const Places& places) {
  std::vector<Aabb> boxes;  // of the finest levels
  for (const Chain& chain : scene.chains)
    boxes.push_back(boundsOf(scene.meshes[chain.levels.front().mesh]));
  std::vector<Aabb> looseBoxes;
  for (const LooseGeometry& geometry : scene.looseGeometries)
    looseBoxes.push_back(boundsOf(geometry));
  Extent extent;
  for (std::size_t i = 0; i < places.instances.size(); ++i)
    extent.add(boxes[scene.instances[i].chain], scene.instances[i].worldFromObject, places.instances[i]);
  for (std::size_t i = 0; i < places.looseInstances.size(); ++i) {
    const LooseInstance& loose = scene.looseInstances[i];
    if (!looseBoxes[loose.geometry].empty())
      extent.add(looseBoxes[loose.geometry], loose.worldFromObject, places.looseInstances[i]);
  }
  return extent;
}

}  // namespace

void placeNearOrigin(SceneFile& scene, const Places& places) {
  JAL_CHECK(places.instances.size() == scene.instances.size());
  JAL_CHECK(places.looseInstances.size() == scene.looseInstances.size());
  const Extent extent = extentOf(scene, places);
  if (!extent.isFar()) return;
  scene.originWorld = glm::round(extent.center());
  for (std::size_t i = 0; i < places.instances.size(); ++i)
    scene.instances[i].worldFromObject[3] = glm::vec4(places.instances[i] - scene.originWorld, 1.0);
  for (std::size_t i = 0; i < places.looseInstances.size(); ++i)
    scene.looseInstances[i].worldFromObject[3] = glm::vec4(places.looseInstances[i] - scene.originWorld, 1.0);
  moveRooms(scene.rooms, -scene.originWorld);
  const glm::dvec4 offset(scene.originWorld, 0.0);
  for (Camera& camera : scene.cameras) {
    camera.worldFromCamera[3] -= offset;
    camera.worldFromParent[3] -= offset;
  }
}

void placeSkins(SceneFile& scene, std::span<const glm::dvec3> instances) {
  if (scene.originWorld == glm::dvec3(0.0)) return;
  std::vector<bool> isSkin(scene.meshes.size(), false);
  const auto shift = [&](std::vector<glm::vec3>& positions) {
    for (glm::vec3& position : positions)
      position = glm::vec3(glm::dvec3(position) - scene.originWorld);
  };
  for (MeshBending& bending : scene.motion.meshes) {
    if (std::none_of(bending.primitives.begin(), bending.primitives.end(),
                     [](const PrimitiveBending& p) { return p.isSkinned; }))
      continue;
    isSkin[bending.mesh] = true;
    for (std::size_t p = 0; p < bending.primitives.size(); ++p) {
      shift(scene.meshes[bending.mesh].primitives[p].positions);
      if (!bending.primitives[p].isSkinned) shift(bending.primitives[p].positions);
    }
  }
  for (std::size_t i = 0; i < instances.size(); ++i) {
    Instance& instance = scene.instances[i];
    if (!isSkin[scene.chains[instance.chain].levels.front().mesh]) continue;
    const glm::dmat3 axes{glm::mat3(instance.worldFromObject)};
    instance.worldFromObject[3] = glm::vec4(axes * scene.originWorld + instances[i] - scene.originWorld, 1.0);
  }
}

}  // namespace jalousie::asset::detail
