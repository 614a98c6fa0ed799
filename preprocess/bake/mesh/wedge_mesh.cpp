// Queries of a wedge mesh.
#include "bake/mesh/wedge_mesh.h"

#include <algorithm>

namespace jalousie::bake {

const AttributeSlot* WedgeMesh::slot(const std::string& name) const {
  const auto found =
      std::find_if(slots.begin(), slots.end(), [&](const AttributeSlot& candidate) { return candidate.name == name; });
  return found == slots.end() ? nullptr : &*found;
}

std::vector<std::uint32_t> vertexIndices(const WedgeMesh& mesh) {
  std::vector<std::uint32_t> indices(mesh.corners.size());
  for (std::size_t c = 0; c < indices.size(); ++c)
    indices[c] = mesh.vertexAt(c);
  return indices;
}

}  // namespace jalousie::bake
