// Finds degenerate and duplicate triangles by welded positions.
#include "bake/mesh/clean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "bake/mesh/normals.h"
#include "bake/mesh/weld.h"

namespace jalousie::bake {

namespace {

/// A triangle by its welded corners, the lowest first, and its primitive.
struct Key {
  std::array<std::uint32_t, 4> ids;
  std::uint32_t triangle;
};

/// Sets positions that are NaN or infinite to zero. @return  for each vertex whether it was finite
std::vector<bool> zeroNotFinite(std::vector<glm::vec3>& positions) {
  std::vector<bool> isFinite(positions.size(), true);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    glm::vec3& p = positions[v];
    isFinite[v] = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (!isFinite[v]) p = glm::vec3(0.0F);
  }
  return isFinite;
}

bool hasArea(const CombinedMesh& mesh, const std::uint32_t* corner) {
  return faceNormal(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]) != glm::dvec3(0.0);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeOf(const Key& key, std::size_t k) {
  return std::minmax(key.ids[k], key.ids[(k + 1) % 3]);
}

/// Of the triangles without area, keeps those that share two edges or more with others: without them, the vertices on
/// a longer edge would lie on an open border. @param keys  of triangles with area; gets those of bridges
void keepBridges(const std::vector<Key>& flat, std::vector<Key>& keys, std::vector<bool>& dropped,
                 CleanCounts& counts) {
  std::map<Edge, std::uint32_t> uses;
  for (const Key& key : flat)
    for (std::size_t k = 0; k < 3; ++k)
      ++uses[edgeOf(key, k)];
  if (keys.empty()) uses.clear();  // a mesh without area is none
  for (std::size_t i = 0; !uses.empty() && i < keys.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = uses.find(edgeOf(keys[i], k)); found != uses.end()) ++found->second;
  }
  for (const Key& key : flat) {
    std::uint32_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = uses.find(edgeOf(key, k));
      shared += found != uses.end() && found->second > 1 ? 1U : 0U;
    }
    if (shared < 2) {
      ++counts.degenerate;
      dropped[key.triangle] = true;
    } else {
      ++counts.bridges;
      keys.push_back(key);
    }
  }
}

/// Marks triangles that are not finite or have no area. @return  the keys of the others
std::vector<Key> dropBroken(const CombinedMesh& mesh, const std::vector<bool>& isFinite, std::vector<bool>& dropped,
                            CleanCounts& counts) {
  const std::vector<std::uint32_t> welded = weldByPosition(mesh.positions);
  std::vector<Key> keys;
  std::vector<Key> flat;
  keys.reserve(dropped.size());
  for (std::uint32_t t = 0; t < dropped.size(); ++t) {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t{t}];
    if (!isFinite[corner[0]] || !isFinite[corner[1]] || !isFinite[corner[2]]) {
      ++counts.notFinite;
      dropped[t] = true;
      continue;
    }
    std::array<std::uint32_t, 3> ids = {welded[corner[0]], welded[corner[1]], welded[corner[2]]};
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) {
      ++counts.degenerate;
      dropped[t] = true;
      continue;
    }
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    (hasArea(mesh, corner) ? keys : flat).push_back({{ids[0], ids[1], ids[2], mesh.primitiveOf[corner[0]]}, t});
  }
  keepBridges(flat, keys, dropped, counts);
  return keys;
}

/// Marks all triangles with one key but the first.
void dropDuplicates(std::vector<Key> keys, std::vector<bool>& dropped, CleanCounts& counts) {
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return a.ids != b.ids ? a.ids < b.ids : a.triangle < b.triangle; });
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].ids != keys[i - 1].ids) continue;
    ++counts.duplicate;
    dropped[keys[i].triangle] = true;
  }
}

void removeTriangles(const std::vector<bool>& dropped, std::vector<std::uint32_t>& indices) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < dropped.size(); ++t) {
    if (dropped[t]) continue;
    std::copy_n(indices.begin() + static_cast<std::ptrdiff_t>(3 * t), 3,
                indices.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += 3;
  }
  indices.resize(kept);
}

}  // namespace

CleanCounts cleanMesh(CombinedMesh& mesh) {
  CleanCounts counts;
  const std::vector<bool> isFinite = zeroNotFinite(mesh.positions);
  std::vector<bool> dropped(mesh.indices.size() / 3, false);
  dropDuplicates(dropBroken(mesh, isFinite, dropped, counts), dropped, counts);
  removeTriangles(dropped, mesh.indices);
  return counts;
}

namespace {

bool sameAttributes(const CombinedMesh& mesh, std::uint32_t a, std::uint32_t b) {
  if (mesh.primitiveOf[a] != mesh.primitiveOf[b]) return false;
  const PrimitiveData& primitive = mesh.primitives[mesh.primitiveOf[a]];
  return std::all_of(primitive.attributes.begin(), primitive.attributes.end(), [&](const Attribute& attribute) {
    if (attribute.name == "POSITION") return true;
    const auto valuesOf = [&](std::uint32_t v) {
      return attribute.values.data() + std::size_t{v - primitive.firstVertex} * attribute.components;
    };
    return std::equal(valuesOf(a), valuesOf(a) + attribute.components, valuesOf(b));
  });
}

}  // namespace

void shareEqualVertices(CombinedMesh& mesh) {
  constexpr std::size_t kMostCandidates = 64;  // any number of different vertices may lie at one place
  const std::vector<std::uint32_t> welded = weldByPosition(mesh.positions);
  std::vector<std::vector<std::uint32_t>> kept(mesh.positions.size());  // by welded vertex
  std::vector<std::uint32_t> shared(mesh.positions.size());
  for (std::uint32_t v = 0; v < shared.size(); ++v) {
    std::vector<std::uint32_t>& candidates = kept[welded[v]];
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](std::uint32_t other) { return sameAttributes(mesh, other, v); });
    shared[v] = found != candidates.end() ? *found : v;
    if (shared[v] == v && candidates.size() < kMostCandidates) candidates.push_back(v);
  }
  for (std::uint32_t& index : mesh.indices)
    index = shared[index];
}

}  // namespace jalousie::bake
