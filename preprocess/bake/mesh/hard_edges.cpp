// Finds the smooth fans around vertices as unions of corners.
#include "bake/mesh/hard_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/union_find.h"
#include "bake/mesh/wedges.h"

namespace jalousie::bake {
namespace {

/// Gives every primitive a NORMAL and sets all normals to zero: vertices that differed only there become equal.
void clearNormals(CombinedMesh& mesh) {
  for (PrimitiveData& primitive : mesh.primitives) {
    auto found = std::find_if(primitive.attributes.begin(), primitive.attributes.end(),
                              [](const Attribute& attribute) { return attribute.name == "NORMAL"; });
    if (found == primitive.attributes.end()) {
      primitive.attributes.push_back({"NORMAL", 3, {}});
      found = primitive.attributes.end() - 1;
    }
    found->values.assign(std::size_t{primitive.vertexCount} * 3, 0.0F);
  }
}

glm::dvec3 normalOfFace(const WedgeMesh& mesh, std::uint32_t corner) {
  const std::size_t first = corner / 3 * 3;
  return faceNormal(mesh.positions[mesh.vertexAt(first)], mesh.positions[mesh.vertexAt(first + 1)],
                    mesh.positions[mesh.vertexAt(first + 2)]);
}

/// For each corner the lowest corner of its smooth fan.
std::vector<std::uint32_t> smoothFans(const WedgeMesh& mesh, double degrees) {
  UnionFind corners(mesh.corners.size());
  const double leastCosine = std::cos(degrees * std::numbers::pi / 180.0) - 1e-9;
  const EdgeTable table = findEdges(mesh);
  for (const MeshEdge& edge : table.edges) {
    if (edge.useCount != 2 || edge.kind == EdgeKind::kNonManifold) continue;
    const std::uint32_t c = table.uses[edge.firstUse];
    const std::uint32_t d = table.uses[edge.firstUse + 1];
    if (glm::dot(normalOfFace(mesh, c), normalOfFace(mesh, d)) < leastCosine) continue;
    corners.unite(c, nextCorner(d));  // c runs a -> b, d runs b -> a
    corners.unite(nextCorner(c), d);
  }
  return corners.roots();
}

double angleAt(const WedgeMesh& mesh, std::uint32_t corner) {
  const std::uint32_t next = nextCorner(corner);
  const glm::dvec3 p(mesh.positions[mesh.vertexAt(corner)]);
  const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.vertexAt(next)]) - p;
  const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.vertexAt(nextCorner(next))]) - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool sameAttributes(const WedgeMesh& mesh, std::uint32_t a, std::uint32_t b) {
  if (mesh.primitiveOf[a] != mesh.primitiveOf[b]) return false;
  const float* x = mesh.attributes.data() + std::size_t{a} * mesh.stride;
  const float* y = mesh.attributes.data() + std::size_t{b} * mesh.stride;
  return std::equal(x, x + mesh.stride, y);
}

}  // namespace

void rebuildNormals(CombinedMesh& mesh, double degrees) {
  clearNormals(mesh);
  WedgeMesh wedges = makeWedges(mesh);
  const AttributeSlot normals = *wedges.slot("NORMAL");
  const std::vector<std::uint32_t> fanOf = smoothFans(wedges, degrees);
  std::vector<glm::dvec3> sums(fanOf.size(), glm::dvec3(0.0));
  for (std::uint32_t c = 0; c < fanOf.size(); ++c)
    sums[fanOf[c]] += angleAt(wedges, c) * normalOfFace(wedges, c);

  // Make one wedge for each fan and each set of other attributes in the fan.
  WedgeMesh result = wedges;
  result.vertexOf.clear();
  result.primitiveOf.clear();
  result.attributes.clear();
  result.sourceWedge.clear();
  std::map<std::uint32_t, std::vector<std::array<std::uint32_t, 2>>> wedgesOfFan;  // old wedge, new wedge
  for (std::uint32_t c = 0; c < fanOf.size(); ++c) {
    const std::uint32_t old = wedges.corners[c];
    auto& known = wedgesOfFan[fanOf[c]];
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto& entry) { return sameAttributes(wedges, entry[0], old); });
    if (found != known.end()) {
      result.corners[c] = (*found)[1];
      continue;
    }
    const auto wedge = static_cast<std::uint32_t>(result.vertexOf.size());
    known.push_back({old, wedge});
    result.corners[c] = wedge;
    result.vertexOf.push_back(wedges.vertexOf[old]);
    result.primitiveOf.push_back(wedges.primitiveOf[old]);
    result.sourceWedge.push_back(old);
    const float* values = wedges.attributes.data() + std::size_t{old} * wedges.stride;
    result.attributes.insert(result.attributes.end(), values, values + wedges.stride);
    const glm::dvec3& sum = sums[fanOf[c]];
    const double length = glm::length(sum);
    for (int k = 0; k < 3; ++k)
      result.attributes[std::size_t{wedge} * result.stride + normals.offset + static_cast<std::uint32_t>(k)] =
          length > 1e-12 ? static_cast<float>(sum[k] / length) : (k == 2 ? 1.0F : 0.0F);
  }
  mesh = combineWedges(result, mesh);
}

}  // namespace jalousie::bake
