// Volumes, cones and spheres of groups, from the triangles up.
#include "scene/face_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/check.h"

namespace jalousie::scene {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Least n.axis of a cone that is of use.
constexpr double kLeastConeCosine = 0.1;

/// The next smaller float, or a smaller one. @param value  finite
float below(double value) {
  return std::nextafterf(static_cast<float>(value), -kInfinity);
}
float above(double value) {
  return std::nextafterf(static_cast<float>(value), kInfinity);
}

glm::vec3 below(const glm::dvec3& v) {
  return {below(v.x), below(v.y), below(v.z)};
}
glm::vec3 above(const glm::dvec3& v) {
  return {above(v.x), above(v.y), above(v.z)};
}

/// What the nodes above a group need of it.
struct Measured {
  asset::CullingVolume volume;
  std::vector<asset::Facet> facets;
  Aabb bounds;
  double inradius = std::numeric_limits<double>::infinity();
};

void setVolume(gpu::FaceNode& node, const asset::CullingVolume& volume) {
  node.lowest = glm::vec4(below(volume.lowest), below(volume.least));
  node.highest = glm::vec4(above(volume.highest), above(volume.most));
  node.origin = glm::vec4(glm::vec3(volume.origin), 0.0F);
}

void setSphere(gpu::FaceNode& node, const Aabb& bounds) {
  const glm::vec3 middle = 0.5F * bounds.min + 0.5F * bounds.max;
  const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(bounds.min) - glm::dvec3(middle)),
                                    glm::abs(glm::dvec3(bounds.max) - glm::dvec3(middle)));
  node.sphere = glm::vec4(middle, above(glm::length(reach)));
}

/// The apex lies on the axis behind all planes.
void setCone(gpu::FaceNode& node, std::span<const asset::Facet> facets) {
  glm::dvec3 sum(0.0);
  for (const asset::Facet& facet : facets)
    sum += facet.normal;
  const double length = glm::length(sum);
  if (!(length > 0.0)) return;
  const glm::vec3 axis(sum / length);
  double cosine = 1.0;
  for (const asset::Facet& facet : facets)
    cosine = std::min(cosine, glm::dot(facet.normal, glm::dvec3(axis)));
  if (cosine < kLeastConeCosine) return;
  const glm::dvec3 middle(node.sphere);
  double back = -std::numeric_limits<double>::infinity();
  for (const asset::Facet& facet : facets)
    back = std::max(back, glm::dot(facet.normal, middle - facet.corner) / glm::dot(facet.normal, glm::dvec3(axis)));
  const glm::dvec3 apex = middle - back * glm::dvec3(axis);
  node.apex = glm::vec4(glm::vec3(apex), 0.0F);
  node.axis = glm::vec4(axis, below(cosine));
}

/// Makes the nodes of one level.
class LodFacets {
 public:
  LodFacets(FaceTables& tables, const FaceGeometry& geometry, const gpu::Lod& lod)
      : tables_(tables), geometry_(geometry), lod_(lod), next_(lod.firstIndex) {}

  void run(std::span<const std::uint32_t> trees) {
    std::vector<Open> open;
    for (const std::uint32_t number : trees) {
      const auto node = static_cast<std::uint32_t>(tables_.nodes.size());
      tables_.nodes.push_back({});
      tables_.nodes[node].firstIndex = next_;
      if (number == 0) {
        open.push_back({node, {}});
        continue;
      }
      Measured done = addGroup(node, number);
      ++groups_;
      // A part that is done completes the nodes above whose second part it is.
      while (!open.empty()) {
        open.back().parts.push_back(std::move(done));
        if (open.back().parts.size() < 2) break;
        done = finish(open.back());
        open.pop_back();
      }
    }
    JAL_CHECK(open.empty());
    tables_.mostGroups = std::max(tables_.mostGroups, groups_);
  }

 private:
  struct Open {
    std::uint32_t node;
    std::vector<Measured> parts;
  };

  glm::vec3 position(std::size_t index) const {
    const std::uint32_t vertex = geometry_.indices[index];
    return geometry_.vertices[static_cast<std::size_t>(lod_.baseVertex) + vertex].position;
  }

  Measured addGroup(std::uint32_t number, std::uint32_t triangles) {
    gpu::FaceNode& node = tables_.nodes[number];
    node.indexCount = 3 * triangles;
    node.next = number + 1;
    node.normals = gpu::kNoNormals;
    Measured measured;
    for (std::size_t i = next_; i < std::size_t{next_} + node.indexCount; i += 3) {
      const asset::Triangle corners{position(i), position(i + 1), position(i + 2)};
      for (const glm::vec3& corner : corners)
        measured.bounds.add(corner);
      measured.facets.push_back(asset::facetOf(corners));
      measured.inradius = std::min(measured.inradius, measured.facets.back().inradius);
    }
    next_ += node.indexCount;
    measured.volume = asset::volumeOf(measured.facets, measured.bounds);
    setVolume(node, measured.volume);
    setSphere(node, measured.bounds);
    node.inradius = std::max(below(measured.inradius), 0.0F);
    if (node.inradius > 0.0F) {
      node.normals = normalRectangle(measured.facets);
      setCone(node, measured.facets);
    }
    measured.facets = {};
    return measured;
  }

  Measured finish(const Open& open) {
    gpu::FaceNode& node = tables_.nodes[open.node];
    node.indexCount = next_ - node.firstIndex;
    node.next = static_cast<std::uint32_t>(tables_.nodes.size());
    node.normals = gpu::kNoNormals;
    const Measured& a = open.parts[0];
    const Measured& b = open.parts[1];
    Measured both;
    both.bounds = a.bounds;
    both.bounds.add(b.bounds);
    both.inradius = std::min(a.inradius, b.inradius);
    both.volume = asset::unite(a.volume, b.volume, 0.5F * both.bounds.min + 0.5F * both.bounds.max);
    setVolume(node, both.volume);
    setSphere(node, both.bounds);
    node.inradius = std::max(below(both.inradius), 0.0F);
    return both;
  }

  FaceTables& tables_;
  const FaceGeometry& geometry_;
  const gpu::Lod& lod_;
  std::uint32_t next_;  ///< first index of the next group
  std::uint32_t groups_ = 0;
};

}  // namespace

std::vector<asset::FaceTree> faceTreesOf(const asset::Primitive& primitive, std::span<const std::uint32_t> ends,
                                         bool fileOrder) {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t end : ends)
    triangles.push_back(end / 3);
  if (fileOrder && !primitive.faceTree.empty()) {
    std::optional<std::vector<asset::FaceTree>> stored = asset::splitFaceTrees(primitive.faceTree, triangles);
    if (stored) return std::move(*stored);
  }
  std::vector<asset::FaceTree> trees(ends.size());
  for (std::size_t cell = 0; cell < ends.size(); ++cell) {
    const std::uint32_t first = cell > 0 ? triangles[cell - 1] : 0;
    if (triangles[cell] > first) trees[cell].push_back(triangles[cell] - first);
  }
  return trees;
}

gpu::uint normalRectangle(std::span<const asset::Facet> facets) {
  static_assert(gpu::kNormalCells == 16);
  const asset::NormalCell first = asset::normalCell(facets[0].normal);
  asset::NormalCell low = first;
  asset::NormalCell high = first;
  for (const asset::Facet& facet : facets) {
    const asset::NormalCell cell = asset::normalCell(facet.normal);
    if (cell.side != first.side) return gpu::kNoNormals;
    low.column = std::min(low.column, cell.column);
    low.row = std::min(low.row, cell.row);
    high.column = std::max(high.column, cell.column);
    high.row = std::max(high.row, cell.row);
  }
  return first.side | low.column << 3U | (high.column + 1) << 8U | low.row << 13U | (high.row + 1) << 18U;
}

void addFaceLod(FaceTables& tables, const FaceGeometry& geometry, const gpu::Lod& lod,
                std::span<const std::uint32_t> trees) {
  gpu::FaceLod made{};
  made.firstNode = static_cast<gpu::uint>(tables.nodes.size());
  made.firstIndex = lod.firstIndex;
  made.solidCount = lod.solidCount;
  made.sheetCount = lod.sheetCount;
  made.baseVertex = lod.baseVertex;
  if (!trees.empty()) LodFacets(tables, geometry, lod).run(trees);
  made.nodeCount = static_cast<gpu::uint>(tables.nodes.size()) - made.firstNode;
  Aabb bounds;
  for (std::uint32_t i = 0; i < lod.solidCount; ++i)
    bounds.add(
        geometry.vertices[static_cast<std::size_t>(lod.baseVertex) + geometry.indices[lod.firstIndex + i]].position);
  if (bounds.empty()) bounds = {glm::vec3(0.0F), glm::vec3(0.0F)};
  made.boundsMinObject = glm::vec4(bounds.min, 0.0F);
  made.boundsMaxObject = glm::vec4(bounds.max, 0.0F);
  tables.lods.push_back(made);
}

}  // namespace jalousie::scene
