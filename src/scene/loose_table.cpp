// Vertices are moved to the world once, because nothing culls them one by one.
#include "scene/loose_table.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/normal_transform.h"

namespace jalousie::scene {

LooseScene makeLooseScene(const asset::SceneFile& file, std::span<const std::uint32_t> hidden) {
  LooseScene scene;
  LooseTable& table = scene.table;
  scene.places.resize(file.looseInstances.size());
  for (const bool isPoints : {false, true}) {
    for (std::size_t i = 0; i < file.looseInstances.size(); ++i) {
      const asset::LooseInstance& loose = file.looseInstances[i];
      const asset::LooseGeometry& geometry = file.looseGeometries[loose.geometry];
      const NormalTransform normals{glm::dmat3(glm::mat3(loose.worldFromObject))};
      LoosePlace& place = scene.places[i];
      place.isShown = !loose.instance || !std::binary_search(hidden.begin(), hidden.end(), *loose.instance);
      (isPoints ? place.firstPoint : place.firstLine) = static_cast<std::uint32_t>(table.vertices.size());
      for (const asset::LooseVertex& vertex : isPoints ? geometry.points : geometry.lines) {
        const glm::vec3 world(loose.worldFromObject * glm::vec4(vertex.position, 1.0F));
        scene.boundsWorld.add(world);
        if (!place.isShown) continue;
        const bool isLit = vertex.normal != glm::vec3(0.0F);
        table.vertices.push_back({world, isLit ? packNormal(normals(vertex.normal)) : 0U, vertex.uv,
                                  packColor(vertex.color), vertex.material});
      }
    }
    if (!isPoints) table.lineVertices = static_cast<std::uint32_t>(table.vertices.size());
  }
  if (table.vertices.size() > std::numeric_limits<std::int32_t>::max())
    throw Error(ErrorCode::kLimit, "the scene has more points and lines than 32-bit counts reach");
  return scene;
}

}  // namespace jalousie::scene
