// Decides whether a mesh is simplified, cleans it and counts what is wrong with it.
#include "bake/io/prepared_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/io/gltf_mesh.h"
#include "bake/io/level_nodes.h"
#include "bake/io/unused_attributes.h"
#include "bake/mesh/bounds.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/hard_edges.h"
#include "bake/mesh/loose_parts.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/subdivide.h"
#include "bake/mesh/wedges.h"
#include "bake/mesh/weld.h"

namespace jalousie::bake {
namespace {

/// Counts the vertices of open edges that a small distance would weld.
void findNearlyWelded(const WedgeMesh& wedges, const EdgeTable& edges, MeshFindings& findings) {
  constexpr double kNear = 1e-5;  // of the diagonal
  std::vector<glm::vec3> border = borderPositions(wedges, edges);
  findings.weldHint = kNear * boundsOf(wedges.positions).diagonal();
  findings.nearlyWelded = snapPositions(border, findings.weldHint);
}

MeshFindings examine(const CombinedMesh& mesh, const CleanCounts& cleaned, const WedgeMesh& wedges) {
  MeshFindings findings;
  findings.cleaned = cleaned;
  for (const PrimitiveData& primitive : mesh.primitives)
    findings.repairedValues += primitive.repairedValues;
  const EdgeTable edges = findEdges(wedges);
  for (const MeshEdge& edge : edges.edges) {
    findings.nonManifoldEdges += edge.kind == EdgeKind::kNonManifold ? 1U : 0U;
    findings.openEdges += edge.kind == EdgeKind::kBorder ? 1U : 0U;
  }
  findings.looseParts = findLooseParts(wedges).parts.size();
  if (findings.openEdges > 0) findNearlyWelded(wedges, edges, findings);
  return findings;
}

CombinedMesh readClean(const tinygltf::Model& model, const tinygltf::Mesh& source, const BakeOptions& options,
                       CleanCounts& cleaned) {
  CombinedMesh mesh = readCombinedMesh(model, source, options.limits);
  cleaned = cleanMesh(mesh);  // positions are finite from here on
  if (options.weld > 0.0) {
    const std::uint64_t snapped = snapPositions(mesh.positions, options.weld);
    shareEqualVertices(mesh);
    const CleanCounts more = cleanMesh(mesh);
    cleaned.degenerate += more.degenerate;
    cleaned.duplicate += more.duplicate;
    cleaned.bridges = more.bridges;
    cleaned.snapped = snapped;
  }
  return mesh;
}

/// What is done to LOD 0. @pre the mesh has triangles
void refine(CombinedMesh& mesh, const BakeOptions& options) {
  subdivideMesh(mesh, options.subdivide);
  if (options.hardAngle) rebuildNormals(mesh, *options.hardAngle);
}

}  // namespace

MeshUse meshUse(const tinygltf::Model& model) {
  MeshUse use{std::vector<std::vector<int>>(model.meshes.size()), levelNodes(model), finestGroupNodes(model)};
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes[n].mesh >= 0)
      use.users[static_cast<std::size_t>(model.nodes[n].mesh)].push_back(static_cast<int>(n));
  return use;
}

std::string nameOf(const tinygltf::Model& model, std::size_t index) {
  const std::string& name = model.meshes[index].name;
  return name.empty() ? fmt::format("mesh {}", index) : name;
}

std::string reasonToPass(const tinygltf::Model& model, std::size_t index, const MeshUse& use) {
  for (const int n : use.users[index]) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(n)];
    if (node.skin >= 0) return "it is skinned";
    if (node.extensions.contains("MSFT_lod"))
      return "it has a chain already, whose levels, cells and groups stay; bake the original for others";
    if (use.isLevel[static_cast<std::size_t>(n)]) return "it is a level of a chain already";
    if (use.isInGroup[static_cast<std::size_t>(n)]) return "it is part of a group that has levels already";
  }
  return unbakeableReason(model, model.meshes[index]);
}

PreparedMesh prepareMesh(const tinygltf::Model& model, std::size_t index, const MeshUse& use,
                         const BakeOptions& options) {
  PreparedMesh prepared;
  const tinygltf::Mesh& source = model.meshes[index];
  MeshReport& report = prepared.report;
  report.name = nameOf(model, index);
  report.nodes = use.users[index].size();
  report.passedThrough = reasonToPass(model, index, use);
  if (!report.passedThrough.empty()) return prepared;

  CombinedMesh& mesh = prepared.mesh;
  std::vector<std::string> unused;
  if (!options.keepUnused) unused = unusedAttributes(model, source);
  CleanCounts cleaned;
  mesh = unused.empty() ? readClean(model, source, options, cleaned)
                        : readClean(model, withoutUnused(model, source), options, cleaned);
  if (mesh.indices.empty() && cleaned.notFinite > 0)
    throw Error(ErrorCode::kMalformed, fmt::format("none of its {} triangles has finite positions", cleaned.notFinite));
  if (mesh.indices.empty()) {
    report.findings.cleaned = cleaned;
    report.passedThrough = "it has no triangle with area";
    return prepared;
  }
  refine(mesh, options);
  if (!unused.empty()) {
    prepared.finest = readClean(model, source, options, cleaned);
    refine(*prepared.finest, options);
  }
  WedgeMesh wedges = makeWedges(mesh);
  report.findings = examine(mesh, cleaned, wedges);
  report.findings.unusedAttributes = std::move(unused);
  report.diagonal = boundsOf(wedges.positions).diagonal();
  if (!std::isfinite(report.diagonal)) {
    report.passedThrough = "its coordinates are too large to measure";
    return prepared;
  }
  prepared.wedges = std::move(wedges);
  return prepared;
}

}  // namespace jalousie::bake
