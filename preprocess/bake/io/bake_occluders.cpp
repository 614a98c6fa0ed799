// Works on the document as it will be written: what is drawn is what boxes are tested against.
#include "bake/io/bake_occluders.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "asset/mesh_occluders.h"
#include "bake/io/level_nodes.h"
#include "bake/mesh/facets.h"
#include "bake/mesh/inner_boxes.h"

namespace jalousie::bake {
namespace {

using tinygltf::Model;

/// The opaque triangles of a mesh.
struct MeshSurface {
  LevelSurface surface;
  std::vector<std::uint8_t> bothSides;  ///< by triangle
  bool isWhole = true;                  ///< the mesh shows nothing else

  bool isDoubleSided() const {
    return std::all_of(bothSides.begin(), bothSides.end(), [](std::uint8_t both) { return both != 0; });
  }
};

void append(MeshSurface& result, const Model& model, const tinygltf::Primitive& primitive,
            const asset::Limits& limits) {
  const auto first = static_cast<std::uint32_t>(result.surface.positions.size());
  const std::vector<glm::vec3> own =
      asset::readVec3(model, primitive.attributes.at("POSITION"), limits.maxAccessorElements);
  const auto count = static_cast<std::uint32_t>(own.size());
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0U);
  if (primitive.indices >= 0) indices = asset::readIndices(model, primitive.indices, count, limits.maxAccessorElements);
  indices.resize(indices.size() - indices.size() % 3);
  result.surface.positions.insert(result.surface.positions.end(), own.begin(), own.end());
  for (const std::uint32_t index : indices)
    result.surface.indices.push_back(first + index);
  const bool bothSides =
      primitive.material >= 0 && model.materials[static_cast<std::size_t>(primitive.material)].doubleSided;
  result.bothSides.resize(result.surface.indices.size() / 3, bothSides ? 1 : 0);
}

/// Leaves out what is not opaque, no list of triangles, or bent by animations.
MeshSurface surfaceOf(const Model& model, const tinygltf::Mesh& mesh, const asset::Limits& limits) {
  MeshSurface result;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const bool isOpaque =
        primitive.material < 0 || model.materials[static_cast<std::size_t>(primitive.material)].alphaMode == "OPAQUE";
    const bool isPlain = primitive.mode == TINYGLTF_MODE_TRIANGLES && primitive.targets.empty() &&
                         primitive.attributes.contains("POSITION") && !primitive.attributes.contains("JOINTS_0");
    if (isOpaque && isPlain)
      append(result, model, primitive, limits);
    else
      result.isWhole = false;
  }
  return result;
}

/// The first levels of a chain whose surfaces are closed, and the opaque part of LOD 0.
struct ChainSurfaces {
  std::vector<LevelSurface> closed;
  bool doubleSided = true;  ///< all that is closed
  MeshSurface finest;
};

ChainSurfaces surfacesOf(const Model& model, int node, const asset::Limits& limits) {
  std::vector<int> nodes = {node};
  const std::vector<int> lower = asset::lodNodes(model, node);
  nodes.insert(nodes.end(), lower.begin(), lower.end());
  ChainSurfaces surfaces;
  for (const int level : nodes) {
    const int mesh = model.nodes[static_cast<std::size_t>(level)].mesh;
    MeshSurface found = surfaceOf(model, model.meshes[static_cast<std::size_t>(mesh)], limits);
    if (level == node) surfaces.finest = found;
    if (!found.isWhole || !isClosed(found.surface)) break;
    surfaces.doubleSided = surfaces.doubleSided && found.isDoubleSided();
    surfaces.closed.push_back(std::move(found.surface));
  }
  return surfaces;
}

/// Boxes inside of as many levels as possible, or else facets of LOD 0.
std::vector<asset::Occluder> findOccluders(const ChainSurfaces& surfaces) {
  InnerBoxOptions options;
  options.insideOut = surfaces.doubleSided;
  std::vector<asset::Occluder> occluders;
  for (std::size_t levels = surfaces.closed.size(); levels > 0 && occluders.empty(); levels /= 2)
    for (const Aabb& box : innerBoxes(std::span(surfaces.closed).first(levels), options))
      occluders.push_back({solidOf(box), static_cast<std::uint32_t>(levels)});
  if (!occluders.empty()) return occluders;
  for (const Facet& facet : largeFacets(surfaces.finest.surface, surfaces.finest.bothSides)) {
    ConvexSolid polygon{{facet.corners.begin(), facet.corners.end()}, {{0, 1, 2, 3}}, facet.bothSides};
    if (!faultOf(polygon)) occluders.push_back({std::move(polygon), 1});
  }
  return occluders;
}

/// Authored solids hold for the levels that their box lies inside of.
void prove(std::vector<asset::Occluder>& occluders, const ChainSurfaces& surfaces) {
  for (asset::Occluder& occluder : occluders) {
    if (occluder.solid.isPolygon()) continue;
    const Aabb box = boundsOf(occluder.solid);
    for (std::size_t levels = surfaces.closed.size(); levels > occluder.levels; --levels)
      if (liesInside(box, std::span(surfaces.closed).first(levels), surfaces.doubleSided))
        occluder.levels = static_cast<std::uint32_t>(levels);
  }
}

}  // namespace

void bakeOccluders(tinygltf::Model& model, const BakeOptions& options) {
  const std::vector<bool> isLower = levelNodes(model);
  std::vector<bool> isDone(model.meshes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const int mesh = model.nodes[n].mesh;
    if (isLower[n] || mesh < 0 || isDone[static_cast<std::size_t>(mesh)]) continue;
    isDone[static_cast<std::size_t>(mesh)] = true;
    std::vector<asset::Occluder> occluders = asset::meshOccluders(model.meshes[static_cast<std::size_t>(mesh)]);
    if (occluders.empty() && !options.occluders) continue;
    if (options.subdivide > 0 || options.weld > 0.0) occluders.clear();
    for (asset::Occluder& occluder : occluders)
      occluder.levels = std::min(occluder.levels, 1U);
    if (options.occluders) {
      const ChainSurfaces surfaces = surfacesOf(model, static_cast<int>(n), options.limits);
      if (occluders.empty())
        occluders = findOccluders(surfaces);
      else
        prove(occluders, surfaces);
    }
    asset::setOccluders(model.meshes[static_cast<std::size_t>(mesh)], occluders);
  }
}

}  // namespace jalousie::bake
