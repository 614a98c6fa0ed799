// meshoptimizer's edge collapse, with and without attribute seams.
#include "bake/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <set>

#include "bake/triangle_mesh.h"

namespace jalousie::bake {
namespace {

/// Any deformation is allowed: the target decides, and the error is measured afterwards.
constexpr float kAnyError = 1e6F;

std::vector<std::uint32_t> collapse(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices,
                                    std::uint32_t targetTriangles) {
  std::vector<std::uint32_t> result(indices.size());
  result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                 sizeof(glm::vec3), std::size_t{3} * targetTriangles, kAnyError));
  return result;
}

/// For each vertex the lowest one with its position and primitive.
std::vector<std::uint32_t> weldWithinPrimitives(const CombinedMesh& mesh) {
  const std::vector<std::uint32_t> byPosition = weldByPosition(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
  std::vector<std::uint32_t> ids(byPosition.size());
  for (std::uint32_t v = 0; v < ids.size(); ++v)
    ids[v] = first.try_emplace({byPosition[v], mesh.primitiveOf[v]}, v).first->second;
  return ids;
}

glm::vec3 normalOf(const CombinedMesh& mesh, std::uint32_t vertex) {
  const PrimitiveData& data = mesh.primitives[mesh.primitiveOf[vertex]];
  for (const Attribute& attribute : data.attributes) {
    if (attribute.name != "NORMAL") continue;
    const std::size_t at = std::size_t{vertex - data.firstVertex} * 3;
    return {attribute.values[at], attribute.values[at + 1], attribute.values[at + 2]};
  }
  return glm::vec3(0.0F);
}

std::vector<std::uint32_t> collapseWelded(const CombinedMesh& mesh, const std::vector<std::uint32_t>& indices,
                                          std::uint32_t targetTriangles) {
  const std::vector<std::uint32_t> ids = weldWithinPrimitives(mesh);
  // Only the welded vertices may be there: the library takes others at their positions for attribute seams.
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> compactOf(ids.size(), kUnused);
  std::vector<std::uint32_t> vertexOf;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> welded;
  for (const std::uint32_t v : indices) {
    std::uint32_t& compact = compactOf[ids[v]];
    if (compact == kUnused) {
      compact = static_cast<std::uint32_t>(positions.size());
      vertexOf.push_back(ids[v]);
      positions.push_back(mesh.positions[v]);
    }
    welded.push_back(compact);
  }
  std::vector<std::uint32_t> result = collapse(positions, welded, targetTriangles);
  for (std::uint32_t& corner : result)
    corner = vertexOf[corner];

  std::map<std::uint32_t, std::set<std::uint32_t>> wedges;
  for (const std::uint32_t v : indices)
    wedges[ids[v]].insert(v);
  for (std::size_t t = 0; t < result.size(); t += 3) {
    const glm::vec3 face(
        faceNormal(mesh.positions[result[t]], mesh.positions[result[t + 1]], mesh.positions[result[t + 2]]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::set<std::uint32_t>& candidates = wedges.at(result[t + k]);
      result[t + k] = *std::max_element(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(normalOf(mesh, a), face) < glm::dot(normalOf(mesh, b), face);
      });
    }
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> simplifyTriangles(const CombinedMesh& mesh, const std::vector<std::uint32_t>& indices,
                                             std::uint32_t targetTriangles) {
  std::vector<std::uint32_t> kept = collapse(mesh.positions, indices, targetTriangles);
  const std::size_t enough = std::size_t{3} * targetTriangles + std::size_t{3} * targetTriangles / 10;
  if (kept.size() <= std::max<std::size_t>(enough, 12)) return kept;
  std::vector<std::uint32_t> welded = collapseWelded(mesh, indices, targetTriangles);
  return welded.size() < kept.size() && !welded.empty() ? welded : kept;
}

}  // namespace jalousie::bake
