// Mesh by mesh: read, clean, subdivide, simplify, measure, write back, link with MSFT_lod.
#include "bake/bake_document.h"

#include <fmt/format.h>
#include <algorithm>

#include "asset/lod_chain.h"
#include "bake/subdivide.h"
#include "core/aabb.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

std::string reasonToPass(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const std::vector<int>& nodes) {
  for (const int n : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(n)];
    if (node.skin >= 0) return "it is skinned";
    if (node.extensions.contains("MSFT_lod")) return "it has a chain already";
  }
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    if (primitive.extensions.contains("KHR_draco_mesh_compression")) return "it is Draco-compressed";
  return unbakeableReason(mesh);
}

/// The node of one level: same place, same instances, no children.
int appendLevelNode(tinygltf::Model& model, const tinygltf::Node& source, int mesh, std::size_t lod) {
  tinygltf::Node node;
  node.name = fmt::format("{}_lod{}", source.name, lod);
  node.mesh = mesh;
  node.translation = source.translation;
  node.rotation = source.rotation;
  node.scale = source.scale;
  node.matrix = source.matrix;
  if (const auto found = source.extensions.find(kInstancing); found != source.extensions.end())
    node.extensions[kInstancing] = found->second;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

void linkNodes(tinygltf::Model& model, const std::vector<int>& nodes, const std::vector<int>& levelMeshes,
               const std::vector<float>& coverage) {
  if (levelMeshes.size() < 2) return;
  for (const int n : nodes) {
    const tinygltf::Node source = model.nodes[static_cast<std::size_t>(n)];
    std::vector<int> lower;
    for (std::size_t k = 1; k < levelMeshes.size(); ++k)
      lower.push_back(appendLevelNode(model, source, levelMeshes[k], k));
    asset::setLodChain(model, n, lower, coverage);
  }
}

MeshReport bakeMesh(tinygltf::Model& model, std::size_t index, const std::vector<int>& nodes,
                    const BakeOptions& options) {
  const tinygltf::Mesh source = model.meshes[index];
  MeshReport report;
  report.name = source.name.empty() ? fmt::format("mesh {}", index) : source.name;
  report.nodes = nodes.size();
  report.passedThrough = reasonToPass(model, source, nodes);
  if (!report.passedThrough.empty()) return report;

  CombinedMesh mesh = readCombinedMesh(model, source, options.limits);
  report.cleaned = cleanMesh(mesh);
  if (mesh.indices.empty()) {
    report.passedThrough = "it has no triangle with area";
    return report;
  }
  subdivideMesh(mesh, options.subdivide);
  Aabb bounds;
  for (const std::uint32_t v : mesh.indices)
    bounds.add(mesh.positions[v]);
  report.diagonal = bounds.diagonal();

  const LevelChain chain = makeChain(mesh, options.chain);
  report.stopReason = chain.stopReason;
  const std::vector<float> coverage = screenCoverage(chain, 0.5 * report.diagonal);
  std::vector<int> levelMeshes;
  for (std::size_t k = 0; k < chain.levels.size(); ++k) {
    const ChainLevel& level = chain.levels[k];
    const WrittenMesh written = appendLevelMesh(model, source, mesh, level.indices);
    tinygltf::Mesh& target = model.meshes[static_cast<std::size_t>(written.mesh)];
    if (k > 0) target.name = fmt::format("{}_lod{}", source.name, k);
    target.extras = k == 0 ? source.extras : tinygltf::Value();
    asset::setLodInfo(target, {static_cast<std::uint32_t>(k), level.triangles(), written.vertices, level.errorMax});
    levelMeshes.push_back(written.mesh);
    report.levels.push_back({level.triangles(), written.vertices, level.errorMax, level.errorMean, coverage[k]});
  }
  // LOD 0 takes the place of the original, so every reference to the mesh stays right.
  model.meshes[index] = std::move(model.meshes[static_cast<std::size_t>(levelMeshes[0])]);
  model.meshes.erase(model.meshes.begin() + levelMeshes[0]);
  for (std::size_t k = 1; k < levelMeshes.size(); ++k)
    --levelMeshes[k];
  levelMeshes[0] = static_cast<int>(index);
  linkNodes(model, nodes, levelMeshes, coverage);
  return report;
}

}  // namespace

std::vector<MeshReport> bakeDocument(tinygltf::Model& model, const BakeOptions& options,
                                     const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::size_t meshes = model.meshes.size();
  std::vector<std::vector<int>> users(meshes);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes[n].mesh >= 0) users[static_cast<std::size_t>(model.nodes[n].mesh)].push_back(static_cast<int>(n));
  std::vector<MeshReport> reports;
  for (std::size_t m = 0; m < meshes; ++m) {
    progress(m, meshes);
    if (users[m].empty()) continue;
    try {
      reports.push_back(bakeMesh(model, m, users[m], options));
    } catch (const Error& error) {
      const std::string name = model.meshes[m].name.empty() ? fmt::format("{}", m) : model.meshes[m].name;
      throw Error(error.code(), fmt::format("mesh '{}': {}", name, error.what()));
    }
  }
  model.asset.generator = "jalousie-bake";
  return reports;
}

}  // namespace jalousie::bake
