// Degenerate and duplicate triangles, found on welded positions.
#include "bake/clean.h"

#include <algorithm>
#include <array>
#include <set>

#include "bake/triangle_mesh.h"

namespace jalousie::bake {

CleanCounts cleanMesh(CombinedMesh& mesh) {
  CleanCounts counts;
  const std::vector<std::uint32_t> welded = weldByPosition(mesh.positions);
  std::set<std::array<std::uint32_t, 4>> seen;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const std::array<std::uint32_t, 3> corner = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    std::array<std::uint32_t, 3> ids = {welded[corner[0]], welded[corner[1]], welded[corner[2]]};
    const glm::dvec3 normal =
        faceNormal(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]);
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0] || normal == glm::dvec3(0.0)) {
      ++counts.degenerate;
      continue;
    }
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    if (!seen.insert({ids[0], ids[1], ids[2], mesh.primitiveOf[corner[0]]}).second) {
      ++counts.duplicate;
      continue;
    }
    std::copy(corner.begin(), corner.end(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += 3;
  }
  mesh.indices.resize(kept);
  return counts;
}

}  // namespace jalousie::bake
