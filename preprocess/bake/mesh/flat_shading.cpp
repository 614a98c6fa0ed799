// Compares corner normals with face normals; splits wedges by face.
#include "bake/mesh/flat_shading.h"

#include <algorithm>
#include <map>

#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/normals.h"

namespace jalousie::bake {
namespace {

constexpr double kSameDirection = 0.9999;  ///< least cosine of normals that are equal up to the precision of files
constexpr double kNearlyAll = 0.99;        ///< share of corners

glm::dvec3 normalOfFace(const WedgeMesh& mesh, std::size_t corner) {
  const std::size_t first = corner / 3 * 3;
  return faceNormal(mesh.positions[mesh.vertexAt(first)], mesh.positions[mesh.vertexAt(first + 1)],
                    mesh.positions[mesh.vertexAt(first + 2)]);
}

/// The corner's wedge in the new mesh: one that is there already, or a copy of the old one with the face's normal.
std::uint32_t wedgeFor(const WedgeMesh& old, std::uint32_t wedge, const glm::dvec3& normal,
                       std::vector<std::uint32_t>& known, WedgeMesh& mesh) {
  const AttributeSlot& slot = *mesh.slot("NORMAL");
  constexpr std::size_t kMostCompared = 16;  // any number of triangles may meet at one vertex
  for (std::size_t i = known.size() > kMostCompared ? known.size() - kMostCompared : 0; i < known.size(); ++i)
    if (glm::dot(glm::dvec3(mesh.vec3At(known[i], slot)), normal) > kSameDirection) return known[i];
  const auto added = static_cast<std::uint32_t>(mesh.vertexOf.size());
  known.push_back(added);
  mesh.vertexOf.push_back(old.vertexOf[wedge]);
  mesh.primitiveOf.push_back(old.primitiveOf[wedge]);
  mesh.sourceWedge.push_back(old.sourceWedge[wedge]);
  const float* values = old.attributes.data() + std::size_t{wedge} * old.stride;
  mesh.attributes.insert(mesh.attributes.end(), values, values + old.stride);
  for (int k = 0; k < 3; ++k)
    mesh.attributes[std::size_t{added} * mesh.stride + slot.offset + static_cast<std::uint32_t>(k)] =
        static_cast<float>(normal[k]);
  return added;
}

}  // namespace

std::vector<bool> flatPrimitives(const WedgeMesh& mesh) {
  const AttributeSlot* normals = mesh.slot("NORMAL");
  if (normals == nullptr || normals->components != 3) return {};
  std::map<std::uint32_t, std::pair<std::uint64_t, std::uint64_t>> counts;  // corners, of them flat
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    auto& [corners, flat] = counts[mesh.primitiveOf[mesh.corners[c]]];
    const glm::dvec3 normal(mesh.vec3At(mesh.corners[c], *normals));
    const double length = glm::length(normal);
    ++corners;
    if (length > 0.0 && glm::dot(normal, normalOfFace(mesh, c)) > kSameDirection * length) ++flat;
  }
  // On a plane, smooth and flat shading are the same.
  std::map<std::uint32_t, bool> bends;
  const EdgeTable table = findEdges(mesh);
  for (const MeshEdge& edge : table.edges) {
    if (edge.kind != EdgeKind::kHard) continue;
    bends[mesh.primitiveOf[mesh.corners[table.uses[edge.firstUse]]]] = true;
  }
  std::vector<bool> result(counts.empty() ? 0 : counts.rbegin()->first + 1, false);
  bool any = false;
  for (const auto& [primitive, count] : counts) {
    result[primitive] =
        bends[primitive] && static_cast<double>(count.second) >= kNearlyAll * static_cast<double>(count.first);
    any = any || result[primitive];
  }
  return any ? result : std::vector<bool>();
}

void restoreFlatShading(const std::vector<bool>& flat, WedgeMesh& level) {
  const AttributeSlot* slot = level.slot("NORMAL");
  if (flat.empty() || slot == nullptr) return;
  const AttributeSlot normals = *slot;
  WedgeMesh mesh;
  mesh.slots = level.slots;
  mesh.stride = level.stride;
  mesh.positions = level.positions;
  std::vector<std::vector<std::uint32_t>> known(level.vertexOf.size());  // by old wedge
  for (std::size_t c = 0; c < level.corners.size(); ++c) {
    const std::uint32_t wedge = level.corners[c];
    const std::uint32_t primitive = level.primitiveOf[wedge];
    glm::dvec3 normal = normalOfFace(level, c);
    const bool isFlat = primitive < flat.size() && flat[primitive] && normal != glm::dvec3(0.0);
    if (!isFlat) normal = glm::dvec3(level.vec3At(wedge, normals));
    if (!isFlat && !known[wedge].empty()) {
      mesh.corners.push_back(known[wedge].front());
      continue;
    }
    mesh.corners.push_back(wedgeFor(level, wedge, normal, known[wedge], mesh));
  }
  level = std::move(mesh);
}

}  // namespace jalousie::bake
