// Sorts half-edges and compares the wedges on their two sides.
#include "bake/mesh/mesh_edges.h"

#include <algorithm>
#include <numeric>

namespace jalousie::bake {
namespace {

struct HalfEdge {
  std::uint64_t key;
  std::uint32_t corner;
};

bool normalsOnlyDiffer(const WedgeMesh& mesh, std::uint32_t w1, std::uint32_t w2) {
  for (const AttributeSlot& slot : mesh.slots) {
    if (slot.kind == AttributeKind::kNormal || slot.kind == AttributeKind::kTangent) continue;
    const float* x = &mesh.attributes[std::size_t{w1} * mesh.stride + slot.offset];
    const float* y = &mesh.attributes[std::size_t{w2} * mesh.stride + slot.offset];
    if (!std::equal(x, x + slot.components, y)) return false;
  }
  return true;
}

/// The kind of an edge with two uses: corner c runs a -> b, corner d runs b -> a.
EdgeKind kindOfPair(const WedgeMesh& mesh, std::uint32_t c, std::uint32_t d) {
  const std::uint32_t a1 = mesh.corners[c];
  const std::uint32_t b1 = mesh.corners[nextCorner(c)];
  const std::uint32_t b2 = mesh.corners[d];
  const std::uint32_t a2 = mesh.corners[nextCorner(d)];
  if (mesh.vertexOf[a1] != mesh.vertexOf[a2]) return EdgeKind::kNonManifold;
  if (a1 == a2 && b1 == b2) return EdgeKind::kSmooth;
  if (mesh.primitiveOf[a1] != mesh.primitiveOf[a2]) return EdgeKind::kMaterial;
  return normalsOnlyDiffer(mesh, a1, a2) && normalsOnlyDiffer(mesh, b1, b2) ? EdgeKind::kHard : EdgeKind::kSeam;
}

}  // namespace

EdgeTable findEdges(const WedgeMesh& mesh) {
  // Bucket sort by the lower vertex, then sort each bucket: a bucket holds a few edges.
  std::vector<std::uint32_t> start(mesh.positions.size() + 1, 0);
  for (std::uint32_t c = 0; c < mesh.corners.size(); ++c)
    ++start[std::min(mesh.vertexAt(c), mesh.vertexAt(nextCorner(c))) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<HalfEdge> halves(mesh.corners.size());
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (std::uint32_t c = 0; c < halves.size(); ++c) {
    const std::uint32_t a = mesh.vertexAt(c);
    const std::uint32_t b = mesh.vertexAt(nextCorner(c));
    halves[fill[std::min(a, b)]++] = {(std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b), c};
  }
  for (std::size_t v = 0; v + 1 < start.size(); ++v)
    std::sort(halves.begin() + start[v], halves.begin() + start[v + 1], [](const HalfEdge& x, const HalfEdge& y) {
      return x.key != y.key ? x.key < y.key : x.corner < y.corner;
    });
  EdgeTable table;
  table.uses.reserve(halves.size());
  table.edges.reserve(halves.size() / 2 + 1);
  for (std::size_t i = 0; i < halves.size();) {
    MeshEdge edge;
    edge.a = static_cast<std::uint32_t>(halves[i].key >> 32U);
    edge.b = static_cast<std::uint32_t>(halves[i].key);
    edge.firstUse = static_cast<std::uint32_t>(i);
    for (const std::uint64_t key = halves[i].key; i < halves.size() && halves[i].key == key; ++i) {
      table.uses.push_back(halves[i].corner);
      ++edge.useCount;
    }
    if (edge.useCount == 1) edge.kind = EdgeKind::kBorder;
    if (edge.useCount == 2) edge.kind = kindOfPair(mesh, table.uses[edge.firstUse], table.uses[edge.firstUse + 1]);
    if (edge.useCount > 2) edge.kind = EdgeKind::kNonManifold;
    table.edges.push_back(edge);
  }
  return table;
}

std::vector<glm::vec3> borderPositions(const WedgeMesh& mesh, const EdgeTable& edges) {
  std::vector<bool> onBorder(mesh.positions.size(), false);
  for (const MeshEdge& edge : edges.edges)
    if (edge.kind == EdgeKind::kBorder) onBorder[edge.a] = onBorder[edge.b] = true;
  std::vector<glm::vec3> positions;
  for (std::size_t v = 0; v < onBorder.size(); ++v)
    if (onBorder[v]) positions.push_back(mesh.positions[v]);
  return positions;
}

}  // namespace jalousie::bake
