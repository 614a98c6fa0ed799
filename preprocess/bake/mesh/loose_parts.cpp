// Unites the vertices of each face, then sorts faces into their parts.
#include "bake/mesh/loose_parts.h"

#include "bake/mesh/normals.h"
#include "bake/mesh/union_find.h"
#include "core/aabb.h"

namespace jalousie::bake {
LooseParts findLooseParts(const WedgeMesh& mesh) {
  constexpr std::uint32_t kNone = ~0U;
  UnionFind vertices(mesh.positions.size());
  const std::uint32_t faces = mesh.triangles();
  for (std::uint32_t f = 0; f < faces; ++f) {
    vertices.unite(mesh.vertexAt(3 * std::size_t{f}), mesh.vertexAt(3 * std::size_t{f} + 1));
    vertices.unite(mesh.vertexAt(3 * std::size_t{f}), mesh.vertexAt(3 * std::size_t{f} + 2));
  }
  LooseParts result;
  std::vector<std::uint32_t> partOf(mesh.positions.size(), kNone);
  std::vector<std::uint32_t> partOfFace(faces);
  std::vector<Aabb> boxes;
  for (std::uint32_t f = 0; f < faces; ++f) {
    std::uint32_t& part = partOf[vertices.rootOf(mesh.vertexAt(3 * std::size_t{f}))];
    if (part == kNone) {
      part = static_cast<std::uint32_t>(result.parts.size());
      result.parts.emplace_back();
      boxes.emplace_back();
    }
    partOfFace[f] = part;
    const glm::vec3& a = mesh.positions[mesh.vertexAt(3 * std::size_t{f})];
    const glm::vec3& b = mesh.positions[mesh.vertexAt(3 * std::size_t{f} + 1)];
    const glm::vec3& c = mesh.positions[mesh.vertexAt(3 * std::size_t{f} + 2)];
    result.parts[part].area += triangleArea(a, b, c);
    ++result.parts[part].faceCount;
    for (const glm::vec3& p : {a, b, c})
      boxes[part].add(p);
  }
  std::uint32_t first = 0;
  for (std::uint32_t p = 0; p < result.parts.size(); ++p) {
    result.parts[p].radius = 0.5 * boxes[p].diagonal();
    result.parts[p].firstFace = first;
    first += result.parts[p].faceCount;
    if (result.parts[p].area > result.parts[result.largest].area) result.largest = p;
  }
  result.faces.resize(faces);
  std::vector<std::uint32_t> fill(result.parts.size(), 0);
  for (std::uint32_t f = 0; f < faces; ++f)
    result.faces[result.parts[partOfFace[f]].firstFace + fill[partOfFace[f]]++] = f;
  return result;
}

}  // namespace jalousie::bake
