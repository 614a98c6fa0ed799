// meshoptimizer's edge collapse, with and without attribute seams.
#include "bake/simplify/draft.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <set>

#include "bake/mesh/normals.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

/// Any deformation is allowed: the target ends the collapse, and the error is measured afterwards.
constexpr float kAnyError = 1e6F;

/// meshopt_simplify, which aborts if more indices are asked for than there are.
/// @param indices  in threes, below the number of positions   @param target  triangles   @return  indices in threes
std::vector<std::uint32_t> simplify(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices,
                                    std::size_t target, bool lockBorder) {
  JAL_CHECK(indices.size() % 3 == 0U);
  if (3 * target >= indices.size()) return indices;
  std::vector<std::uint32_t> result(indices.size());
  result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                 sizeof(glm::vec3), 3 * target, kAnyError,
                                 lockBorder ? meshopt_SimplifyLockBorder : 0));
  return result;
}

/// Collapses an indexed mesh. Only vertices in use are passed: the library would treat unused vertices at equal
/// positions as attribute seams.
std::vector<std::uint32_t> collapse(const WedgeMesh& mesh, const std::vector<std::uint32_t>& indices,
                                    std::uint32_t target, bool lockBorder) {
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> compactOf(mesh.vertexOf.size(), kUnused);
  std::vector<std::uint32_t> original;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> compact;
  compact.reserve(indices.size());
  for (const std::uint32_t index : indices) {
    if (compactOf[index] == kUnused) {
      compactOf[index] = static_cast<std::uint32_t>(original.size());
      original.push_back(index);
      positions.push_back(mesh.positions[mesh.vertexOf[index]]);
    }
    compact.push_back(compactOf[index]);
  }
  std::vector<std::uint32_t> result = simplify(positions, compact, target, lockBorder);
  for (std::uint32_t& index : result)
    index = original[index];
  return result;
}

/// Collapses the vertices of each primitive without regard to attributes; corners then choose among their wedges.
std::vector<std::uint32_t> collapseWelded(const WedgeMesh& mesh, const std::vector<std::uint32_t>& corners,
                                          std::uint32_t target, bool lockBorder) {
  // Wedge that stands for all wedges of a vertex in one primitive.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
  std::map<std::uint32_t, std::set<std::uint32_t>> choices;
  std::vector<std::uint32_t> welded;
  for (const std::uint32_t wedge : corners) {
    const std::uint32_t standsFor =
        first.try_emplace({mesh.vertexOf[wedge], mesh.primitiveOf[wedge]}, wedge).first->second;
    choices[standsFor].insert(wedge);
    welded.push_back(standsFor);
  }
  std::vector<std::uint32_t> result = collapse(mesh, welded, target, lockBorder);
  const AttributeSlot* normals = mesh.slot("NORMAL");
  if (normals == nullptr) return result;
  for (std::size_t c = 0; c < result.size(); c += 3) {
    const glm::vec3 face(faceNormal(mesh.positions[mesh.vertexOf[result[c]]],
                                    mesh.positions[mesh.vertexOf[result[c + 1]]],
                                    mesh.positions[mesh.vertexOf[result[c + 2]]]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::set<std::uint32_t>& wedges = choices.at(result[c + k]);
      result[c + k] = *std::max_element(wedges.begin(), wedges.end(), [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(mesh.vec3At(a, *normals), face) < glm::dot(mesh.vec3At(b, *normals), face);
      });
    }
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> draftCorners(const WedgeMesh& mesh, const std::vector<std::uint32_t>& corners,
                                        std::uint32_t target, bool lockBorder) {
  std::vector<std::uint32_t> kept = collapse(mesh, corners, target, lockBorder);
  const std::size_t enough = std::size_t{3} * target + std::size_t{3} * target / 10;
  if (kept.size() <= std::max<std::size_t>(enough, 12)) return kept;
  std::vector<std::uint32_t> welded = collapseWelded(mesh, corners, target, lockBorder);
  return welded.size() < kept.size() && !welded.empty() ? welded : kept;
}

DraftLevel draftLevel(const WedgeMesh& mesh, const std::vector<std::uint32_t>& corners) {
  constexpr std::uint32_t kGone = ~0U;
  DraftLevel level;
  level.mesh.slots = mesh.slots;
  level.mesh.stride = mesh.stride;
  level.vertexMap.assign(mesh.positions.size(), kGone);
  std::vector<std::uint32_t> wedgeAt(mesh.vertexOf.size(), kGone);
  for (const std::uint32_t w : corners) {
    std::uint32_t& vertex = level.vertexMap[mesh.vertexOf[w]];
    if (vertex == kGone) {
      vertex = static_cast<std::uint32_t>(level.mesh.positions.size());
      level.mesh.positions.push_back(mesh.positions[mesh.vertexOf[w]]);
    }
    if (wedgeAt[w] == kGone) {
      wedgeAt[w] = static_cast<std::uint32_t>(level.mesh.vertexOf.size());
      level.mesh.vertexOf.push_back(vertex);
      level.mesh.primitiveOf.push_back(mesh.primitiveOf[w]);
      level.mesh.sourceWedge.push_back(w);
      const float* values = mesh.attributes.data() + std::size_t{w} * mesh.stride;
      level.mesh.attributes.insert(level.mesh.attributes.end(), values, values + mesh.stride);
    }
    level.mesh.corners.push_back(wedgeAt[w]);
  }
  return level;
}

}  // namespace jalousie::bake
