// Simplifies, measures, divides into cells and writes.
#include "bake/io/baked_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "asset/gltf_quantize.h"
#include "asset/lod_chain.h"
#include "bake/io/attribute_range.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/level_cells.h"
#include "bake/io/lod_measures.h"
#include "bake/io/touching_meshes.h"
#include "bake/mesh/bounds.h"
#include "bake/mesh/wedges.h"

namespace jalousie::bake {
namespace {

asset::LodInfo lodInfoOf(const LevelChain& chain, std::size_t k, double diagonal, float coverage) {
  const ChainLevel& level = chain.levels[k];
  asset::LodMeasures measures = lodMeasures(level.deviation);
  measures.diagonal = diagonal;
  measures.coverage = coverage;
  measures.target = level.target;
  if (k + 1 == chain.levels.size()) measures.stop = chain.stopReason;
  return {static_cast<std::uint32_t>(k), level.mesh.triangles(), 0, level.errorMax, measures};
}

std::uint64_t groupCount(const asset::LodFaces& faces) {
  std::uint64_t groups = 0;
  for (const asset::FaceTree& tree : faces.trees)
    groups +=
        static_cast<std::uint64_t>(tree.size()) - static_cast<std::uint64_t>(std::count(tree.begin(), tree.end(), 0U));
  return groups;
}

/// Appends one level as a mesh. @param k  gets the number of vertices, level 0 that of its groups   @return  its index
int writeLevel(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& level, std::size_t k,
               BakedMesh& baked) {
  asset::LodInfo& info = baked.prepared.report.levels[k];
  const bool hasLevels = baked.chain.levels[k].cells.has_value();
  const CellOrder order = hasLevels ? orderByCells(baked.chain, k) : orderByCells(level, baked.tree);
  const WrittenMesh written = appendLevelMesh(model, source, level, order, baked.faces);
  if (k == 0) baked.prepared.report.faceGroups = groupCount(written.faces);
  tinygltf::Mesh& target = model.meshes[static_cast<std::size_t>(written.mesh)];
  if (info.lod > 0) target.name = fmt::format("{}_lod{}", source.name, info.lod);
  target.extras = info.lod == 0 ? source.extras : tinygltf::Value();
  if (info.lod == 0) target.extensions = source.extensions;
  info.vertices = written.vertices;
  asset::setLodInfo(target, info);
  if (baked.tree || hasLevels) asset::setLodCells(target, written.cells);
  if (hasLevels) asset::setLodCellLevels(target, cellLevelsOf(baked.chain, k));
  asset::setLodFaces(target, written.faces);
  return written.mesh;
}

CombinedMesh combinedLevel(const BakedMesh& baked, std::size_t k) {
  if (k == 0 && baked.prepared.finest) return combineWedges(makeWedges(*baked.prepared.finest), *baked.prepared.finest);
  CombinedMesh level = combineWedges(baked.chain.levels[k].mesh, baked.prepared.mesh);
  if (k > 0) clampToRange(level, baked.prepared.mesh);
  return level;
}

/// The rounding of a mesh and its levels, which lie within the largest error of the mesh.
double quantizeReserve(const WedgeMesh& mesh, const ChainOptions& chain, double diagonal) {
  const glm::vec3 extent = boundsOf(mesh.positions).extent();
  const double beyond = 0.01 * chain.errors.back() * chain.reference.value_or(diagonal);
  return asset::quantizeRounding(double{std::max({extent.x, extent.y, extent.z})} + 2.0 * beyond);
}

/// Whether LOD 0 as it is written has the triangles that are simplified, in their order.
bool hasTrianglesOf(const CombinedMesh& finest, const CombinedMesh& mesh) {
  if (finest.indices.size() != mesh.indices.size()) return false;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    if (finest.positions[finest.indices[i]] != mesh.positions[mesh.indices[i]]) return false;
  return true;
}

/// Triangles of cells with levels of their own; 0 if the options or the mesh have none.
std::uint32_t trianglesOfCellLevels(const PreparedMesh& prepared, const BakeOptions& options) {
  if (!options.cells.levels) return 0;
  if (prepared.finest && !hasTrianglesOf(*prepared.finest, prepared.mesh)) return 0;
  return cellTriangles(prepared.mesh, options.cells);
}

}  // namespace

BakedMesh bakeMesh(const tinygltf::Model& model, std::size_t index, const MeshUse& use, const BakeOptions& options,
                   const LevelProgress& progress) {
  BakedMesh baked;
  baked.prepared = prepareMesh(model, index, use, options);
  const std::optional<WedgeMesh>& wedges = baked.prepared.wedges;
  if (!wedges) return baked;
  MeshReport& report = baked.prepared.report;
  ChainOptions chain = options.chain;
  chain.collapse.lockedVertices = verticesAt(*wedges, options.locked);
  chain.cellTriangles = trianglesOfCellLevels(baked.prepared, options);
  if (options.quantized && !chain.errors.empty()) chain.errorReserve = quantizeReserve(*wedges, chain, report.diagonal);
  baked.chain = makeChain(*wedges, chain, progress);
  report.stopReason = baked.chain.stopReason;
  report.endsInNothing = baked.chain.endsInNothing;
  baked.coverage = screenCoverage(baked.chain, 0.5 * report.diagonal, options.screen);
  for (std::size_t k = 0; k < baked.chain.levels.size(); ++k)
    report.levels.push_back(lodInfoOf(baked.chain, k, report.diagonal, baked.coverage[k]));
  for (const ChainLevel& level : baked.chain.levels)
    report.removedParts.push_back(level.removedParts);
  baked.faces = options.faces;
  const std::optional<CellDivision>& cells = baked.chain.levels.front().cells;
  if (!cells) baked.tree = divideIntoCells(baked.prepared.mesh, options.cells);
  report.cells = cells ? cells->cells : baked.tree ? baked.tree->cellCount() : 0;
  baked.prepared.wedges.reset();  // the chain has a copy
  return baked;
}

std::vector<int> writeLevels(tinygltf::Model& model, std::size_t index, BakedMesh& baked) {
  const tinygltf::Mesh source = model.meshes[index];
  std::vector<int> levelMeshes;
  for (std::size_t k = 0; k < baked.chain.levels.size(); ++k)
    levelMeshes.push_back(writeLevel(model, source, combinedLevel(baked, k), k, baked));
  // LOD 0 takes the index of the original mesh, so references to it stay valid.
  model.meshes[index] = std::move(model.meshes[static_cast<std::size_t>(levelMeshes[0])]);
  model.meshes.erase(model.meshes.begin() + levelMeshes[0]);
  for (std::size_t k = 1; k < levelMeshes.size(); ++k)
    --levelMeshes[k];
  levelMeshes[0] = static_cast<int>(index);
  return levelMeshes;
}

}  // namespace jalousie::bake
