// For each mesh: reads, cleans, subdivides, simplifies, measures, writes back, and links levels with MSFT_lod.
#include "bake/io/bake_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "bake/io/attribute_range.h"
#include "bake/io/equal_meshes.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/level_nodes.h"
#include "bake/io/lod_measures.h"
#include "bake/io/node_scales.h"
#include "bake/io/unused_attributes.h"
#include "bake/mesh/bounds.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/hard_edges.h"
#include "bake/mesh/loose_parts.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/subdivide.h"
#include "bake/mesh/wedges.h"
#include "bake/mesh/weld.h"
#include "bake/simplify/chain.h"
#include "bake/simplify/scene_budget.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

std::string reasonToPass(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const std::vector<int>& nodes,
                         const std::vector<bool>& isLevel) {
  for (const int n : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(n)];
    if (node.skin >= 0) return "it is skinned";
    if (node.extensions.contains("MSFT_lod")) return "it has a chain already";
    if (isLevel[static_cast<std::size_t>(n)]) return "it is a level of a chain already";
  }
  return unbakeableReason(mesh);
}

/// Extensions that go with a node's mesh.
bool belongsToMesh(const std::string& extension) {
  return extension == kInstancing || extension == "EXT_instance_features";
}

/// Appends the node of one level: same transform, same instances, no children.
int appendLevelNode(tinygltf::Model& model, const tinygltf::Node& source, int mesh, std::size_t lod) {
  tinygltf::Node node;
  node.name = fmt::format("{}_lod{}", source.name, lod);
  node.mesh = mesh;
  node.translation = source.translation;
  node.rotation = source.rotation;
  node.scale = source.scale;
  node.matrix = source.matrix;
  for (const auto& extension : source.extensions)
    if (belongsToMesh(extension.first)) node.extensions.insert(extension);
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

/// The channels that move each node: pairs of animation and channel, by node.
using ChannelIndex = std::multimap<int, std::pair<std::size_t, std::size_t>>;

ChannelIndex indexChannels(const tinygltf::Model& model) {
  ChannelIndex index;
  for (std::size_t a = 0; a < model.animations.size(); ++a)
    for (std::size_t c = 0; c < model.animations[a].channels.size(); ++c)
      if (model.animations[a].channels[c].target_path != "weights")
        index.emplace(model.animations[a].channels[c].target_node, std::pair(a, c));
  return index;
}

/// Copies every channel that moves the node of LOD 0 to the nodes of the levels.
void animateLevels(tinygltf::Model& model, const ChannelIndex& channels, int node, const std::vector<int>& levels) {
  const auto [first, last] = channels.equal_range(node);
  for (auto at = first; at != last; ++at) {
    std::vector<tinygltf::AnimationChannel>& list = model.animations[at->second.first].channels;
    for (const int level : levels) {
      tinygltf::AnimationChannel copy = list[at->second.second];
      copy.target_node = level;
      list.push_back(std::move(copy));
    }
  }
}

/// The document before the bake.
struct Before {
  std::vector<std::vector<int>> users;  ///< per mesh the nodes that use it
  std::vector<bool> isLevel;            ///< per node
  ChannelIndex channels;
};

/// Readers replace the whole node when a level is shown. What else a node holds would vanish with its mesh: children,
/// cameras, lights and whatever extensions make of it. Extras that are no object have no place for the coverage.
bool holdsMoreThanItsMesh(const tinygltf::Node& node) {
  return !node.children.empty() || node.camera >= 0 ||
         (node.extras.Type() != tinygltf::NULL_TYPE && !node.extras.IsObject()) ||
         std::any_of(node.extensions.begin(), node.extensions.end(),
                     [](const auto& extension) { return !belongsToMesh(extension.first); });
}

/// Moves the mesh of a node, and its instances, into a new child. @return  the child
int moveMeshIntoChild(tinygltf::Model& model, int parent) {
  const auto index = static_cast<int>(model.nodes.size());
  tinygltf::Node& node = model.nodes[static_cast<std::size_t>(parent)];
  tinygltf::Node child;
  child.name = node.name;
  child.mesh = std::exchange(node.mesh, -1);
  for (auto at = node.extensions.begin(); at != node.extensions.end();) {
    if (!belongsToMesh(at->first)) {
      ++at;
      continue;
    }
    child.extensions.insert(*at);
    at = node.extensions.erase(at);
  }
  node.children.push_back(index);
  model.nodes.push_back(std::move(child));
  return index;
}

void linkNodes(tinygltf::Model& model, const Before& before, const std::vector<int>& nodes,
               const std::vector<int>& levelMeshes, const std::vector<float>& coverage) {
  if (levelMeshes.size() < 2) return;
  for (const int user : nodes) {
    const bool divide = holdsMoreThanItsMesh(model.nodes[static_cast<std::size_t>(user)]);
    const int n = divide ? moveMeshIntoChild(model, user) : user;
    const tinygltf::Node source = model.nodes[static_cast<std::size_t>(n)];
    std::vector<int> lower;
    for (std::size_t k = 1; k < levelMeshes.size(); ++k)
      lower.push_back(appendLevelNode(model, source, levelMeshes[k], k));
    asset::setLodChain(model, n, lower, coverage);
    if (!divide) animateLevels(model, before.channels, n, lower);
  }
}

/// Refuses a mesh that is passed on as it is but holds numbers that are NaN or infinite. @param reason  why it is
/// @param known  accessors that are finite; meshes may share them
void requireFinite(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const std::string& reason,
                   std::set<int>& known) {
  const auto check = [&](const std::map<std::string, int>& attributes) {
    for (const auto& [name, accessor] : attributes) {
      if (!known.insert(accessor).second) continue;
      if (!asset::holdsFiniteNumbers(model, accessor))
        throw Error(ErrorCode::kMalformed,
                    fmt::format("{} holds NaN or an infinite number and cannot be repaired, because {}", name, reason));
    }
  };
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    check(primitive.attributes);
    for (const auto& target : primitive.targets)
      check(target);
  }
}

/// Counts the vertices of open edges that a small distance would weld.
void findNearlyWelded(const WedgeMesh& wedges, const EdgeTable& edges, MeshFindings& findings) {
  constexpr double kNear = 1e-5;  // of the diagonal
  std::vector<bool> onBorder(wedges.positions.size(), false);
  for (const MeshEdge& edge : edges.edges)
    if (edge.kind == EdgeKind::kBorder) onBorder[edge.a] = onBorder[edge.b] = true;
  std::vector<glm::vec3> border;
  for (std::size_t v = 0; v < onBorder.size(); ++v)
    if (onBorder[v]) border.push_back(wedges.positions[v]);
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

asset::LodInfo lodInfoOf(const LevelChain& chain, std::size_t k, double diagonal, float coverage) {
  const ChainLevel& level = chain.levels[k];
  asset::LodMeasures measures = lodMeasures(level.deviation);
  measures.diagonal = diagonal;
  measures.coverage = coverage;
  if (k + 1 == chain.levels.size()) measures.stop = chain.stopReason;
  return {static_cast<std::uint32_t>(k), level.mesh.triangles(), 0, level.errorMax, measures};
}

/// Appends one level as a mesh. @param info  gets the number of vertices   @return  its index
int writeLevel(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& level,
               const std::optional<asset::CellTree>& tree, asset::LodInfo& info) {
  const WrittenMesh written = appendLevelMesh(model, source, level, orderByCells(level, tree));
  tinygltf::Mesh& target = model.meshes[static_cast<std::size_t>(written.mesh)];
  if (info.lod > 0) target.name = fmt::format("{}_lod{}", source.name, info.lod);
  target.extras = info.lod == 0 ? source.extras : tinygltf::Value();
  if (info.lod == 0) target.extensions = source.extensions;
  info.vertices = written.vertices;
  asset::setLodInfo(target, info);
  if (tree) asset::setLodCells(target, written.cells);
  return written.mesh;
}

/// One mesh that was simplified and is not yet written.
struct BakedMesh {
  MeshReport report;
  CombinedMesh mesh;                   ///< as it was simplified
  std::optional<CombinedMesh> finest;  ///< LOD 0 if it has more attributes than the mesh that was simplified
  LevelChain chain;                    ///< without levels if the mesh is passed through
  std::vector<float> coverage;
  std::optional<asset::CellTree> tree;
};

CombinedMesh combinedLevel(const BakedMesh& baked, std::size_t k) {
  if (k == 0 && baked.finest) return combineWedges(makeWedges(*baked.finest), *baked.finest);
  CombinedMesh level = combineWedges(baked.chain.levels[k].mesh, baked.mesh);
  if (k > 0) clampToRange(level, baked.mesh);
  return level;
}

/// Writes the levels as meshes, LOD 0 in the place of the original. @return  their indices
std::vector<int> writeLevels(tinygltf::Model& model, std::size_t index, BakedMesh& baked) {
  const tinygltf::Mesh source = model.meshes[index];
  std::vector<int> levelMeshes;
  for (std::size_t k = 0; k < baked.chain.levels.size(); ++k)
    levelMeshes.push_back(writeLevel(model, source, combinedLevel(baked, k), baked.tree, baked.report.levels[k]));
  // LOD 0 takes the index of the original mesh, so references to it stay valid.
  model.meshes[index] = std::move(model.meshes[static_cast<std::size_t>(levelMeshes[0])]);
  model.meshes.erase(model.meshes.begin() + levelMeshes[0]);
  for (std::size_t k = 1; k < levelMeshes.size(); ++k)
    --levelMeshes[k];
  levelMeshes[0] = static_cast<int>(index);
  return levelMeshes;
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

/// Called with the triangles of each finished level.
using LevelProgress = std::function<void(std::uint32_t)>;

/// The name of a mesh in reports.
std::string nameOf(const tinygltf::Model& model, std::size_t index) {
  const std::string& name = model.meshes[index].name;
  return name.empty() ? fmt::format("mesh {}", index) : name;
}

/// Reads a mesh up to what is simplified. @return  nullopt if it is passed through; the report says why
std::optional<WedgeMesh> prepareMesh(const tinygltf::Model& model, std::size_t index, const Before& before,
                                     const BakeOptions& options, BakedMesh& baked) {
  const std::vector<int>& nodes = before.users[index];
  const tinygltf::Mesh& source = model.meshes[index];
  MeshReport& report = baked.report;
  report.name = nameOf(model, index);
  report.nodes = nodes.size();
  report.passedThrough = reasonToPass(model, source, nodes, before.isLevel);
  if (!report.passedThrough.empty()) return std::nullopt;

  CombinedMesh& mesh = baked.mesh;
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
    return std::nullopt;
  }
  refine(mesh, options);
  if (!unused.empty()) {
    baked.finest = readClean(model, source, options, cleaned);
    refine(*baked.finest, options);
  }
  WedgeMesh wedges = makeWedges(mesh);
  report.findings = examine(mesh, cleaned, wedges);
  report.findings.unusedAttributes = std::move(unused);
  report.diagonal = boundsOf(wedges.positions).diagonal();
  if (!std::isfinite(report.diagonal)) {
    report.passedThrough = "its coordinates are too large to measure";
    return std::nullopt;
  }
  return wedges;
}

/// Reads and simplifies a mesh. Changes nothing, so meshes can be baked side by side.
BakedMesh bakeMesh(const tinygltf::Model& model, std::size_t index, const Before& before, const BakeOptions& options,
                   const LevelProgress& progress) {
  BakedMesh baked;
  const std::optional<WedgeMesh> wedges = prepareMesh(model, index, before, options, baked);
  if (!wedges) return baked;
  MeshReport& report = baked.report;
  baked.chain = makeChain(*wedges, options.chain, progress);
  report.stopReason = baked.chain.stopReason;
  baked.coverage = screenCoverage(baked.chain, 0.5 * report.diagonal, options.screen);
  for (std::size_t k = 0; k < baked.chain.levels.size(); ++k)
    report.levels.push_back(lodInfoOf(baked.chain, k, report.diagonal, baked.coverage[k]));
  for (const ChainLevel& level : baked.chain.levels)
    report.removedParts.push_back(level.removedParts);
  baked.tree = divideIntoCells(baked.mesh, options.cells);
  report.cells = baked.tree ? baked.tree->cellCount() : 0;
  return baked;
}

/// Calls a function for a mesh; its errors name the mesh.
template <class Work>
auto named(const tinygltf::Model& model, std::size_t index, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    const std::string name = model.meshes[index].name.empty() ? fmt::format("{}", index) : model.meshes[index].name;
    throw Error(error.code(), fmt::format("mesh '{}': {}", name, error.what()));
  }
}

/// Meshes that are baked side by side and then written in order, so that the file does not depend on the threads. Few
/// are held in memory at a time. A large mesh is a batch of its own: it uses all threads.
constexpr std::uint64_t kLargeMesh = 100'000;
constexpr std::size_t kMostTogether = 512;

/// Elements that a mesh reads, about.
std::uint64_t sizeOf(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  std::uint64_t elements = 0;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const auto position = primitive.attributes.find("POSITION");
    const int accessor = primitive.indices >= 0                   ? primitive.indices
                         : position != primitive.attributes.end() ? position->second
                                                                  : -1;
    if (accessor >= 0) elements += model.accessors[static_cast<std::size_t>(accessor)].count;
  }
  return elements;
}

/// The end of the batch that begins with the mesh used[first].
std::size_t batchEnd(const tinygltf::Model& model, const std::vector<std::size_t>& used, std::size_t first) {
  std::uint64_t elements = 0;
  std::size_t end = first;
  while (end < used.size() && end - first < kMostTogether) {
    elements += sizeOf(model, model.meshes[used[end]]);
    if (end > first && elements > kLargeMesh) break;
    ++end;
  }
  return end;
}

/// Primitives may share accessors, but each primitive reads them again: a small file could demand any amount of work.
constexpr std::uint64_t kFreeElements = 1ULL << 20U;
constexpr std::uint64_t kMaxElementsPerByte = 64;

void checkDemand(const tinygltf::Model& model) {
  const auto count = [&](int accessor) {
    return accessor < 0 ? 0 : std::uint64_t{model.accessors[static_cast<std::size_t>(accessor)].count};
  };
  std::uint64_t bytes = 0;
  for (const tinygltf::Buffer& buffer : model.buffers)
    bytes += buffer.data.size();
  std::uint64_t elements = 0;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const std::uint64_t indices = count(primitive.indices);
      elements += indices;
      for (const auto& [name, accessor] : primitive.attributes) {
        // Of a large shared buffer only the vertices in use are read.
        const bool inPart = primitive.indices >= 0 && accessor >= 0 &&
                            !model.accessors[static_cast<std::size_t>(accessor)].sparse.isSparse;
        elements += inPart ? std::min(count(accessor), 2 * indices) : count(accessor);
      }
    }
  }
  if (elements > kFreeElements + kMaxElementsPerByte * bytes)
    throw Error(ErrorCode::kLimit, fmt::format("the meshes read {} elements out of {} bytes", elements, bytes));
}

/// The share of each mesh in a scene of one budget.
struct Budget {
  std::vector<std::vector<std::uint32_t>> targets;  ///< by mesh; see ChainOptions::targets
  std::vector<double> untilLength;                  ///< by mesh; see ChainOptions::untilLength
};

/// What a mesh offers, and the radius of the scene's part that it takes. @param scale  see nodeScales
BudgetMesh budgetOf(const tinygltf::Model& model, std::size_t index, const Before& before, const BakeOptions& options,
                    double scale) {
  BudgetMesh offer{0, before.users[index].size(), {}};
  BakedMesh unused;
  const std::optional<WedgeMesh> wedges = prepareMesh(model, index, before, options, unused);
  if (!wedges) return offer;
  offer.triangles = wedges->triangles();
  offer.costs = costCurve(*wedges, options.chain);
  offer.diagonal = scale * unused.report.diagonal;
  for (CostPoint& point : offer.costs)
    point.cost *= scale * scale;
  return offer;
}

/// @param used  meshes that nodes use   @return  nullopt if the meshes are baked each with its own ratios
std::optional<Budget> shareScene(const tinygltf::Model& model, const std::vector<std::size_t>& used,
                                 const Before& before, const BakeOptions& options) {
  if (!options.sceneBudget || used.size() < 2 || options.chain.preset == Preset::kDraft) return std::nullopt;
  const std::vector<double> scales = nodeScales(model);
  const auto scaleOf = [&](std::size_t mesh) {
    double largest = 0.0;
    for (const int node : before.users[mesh])
      largest = std::max(largest, scales[static_cast<std::size_t>(node)]);
    return largest;
  };
  std::vector<BudgetMesh> offers(used.size());
  options.tasks(used.size(), [&](std::size_t i) {
    offers[i] = named(model, used[i], [&] { return budgetOf(model, used[i], before, options, scaleOf(used[i])); });
  });
  std::vector<std::vector<std::uint32_t>> targets = shareBudget(offers, options.chain);
  double largest = 0.0;
  for (const BudgetMesh& offer : offers)
    largest = std::max(largest, offer.diagonal);
  Budget budget{std::vector<std::vector<std::uint32_t>>(model.meshes.size()),
                std::vector<double>(model.meshes.size(), 0.0)};
  for (std::size_t i = 0; i < used.size(); ++i) {
    budget.targets[used[i]] = std::move(targets[i]);
    const double scale = scaleOf(used[i]);
    // Small meshes may err by more than their own size allows: what counts is the largest mesh.
    budget.untilLength[used[i]] = scale > 0.0 ? options.chain.untilError * 0.01 * largest / scale : 0.0;
  }
  return budget;
}

/// The options of one mesh.
BakeOptions optionsFor(const BakeOptions& options, const std::optional<Budget>& budget, std::size_t mesh) {
  BakeOptions own = options;
  if (!budget) return own;
  own.chain.targets = budget->targets[mesh];
  own.chain.untilLength = budget->untilLength[mesh];
  own.chain.ratios.clear();
  own.chain.coarsest.reset();
  if (own.chain.targets.empty()) own.chain.levels = 1;
  return own;
}

std::vector<BakedMesh> bakeBatch(const tinygltf::Model& model, std::span<const std::size_t> batch, const Before& before,
                                 const std::function<BakeOptions(std::size_t)>& optionsOf,
                                 const std::function<void(const std::string&)>& progress) {
  const BakeOptions options = optionsOf(batch.front());
  std::vector<BakedMesh> baked(batch.size());
  const auto bake = [&](std::size_t i, const BakeOptions& used, const LevelProgress& levels) {
    baked[i] = named(model, batch[i], [&] { return bakeMesh(model, batch[i], before, used, levels); });
  };
  if (batch.size() == 1) {
    bake(0, options, [&](std::uint32_t triangles) {
      progress(fmt::format("{}: {} triangles", model.meshes[batch[0]].name, triangles));
    });
    return baked;
  }
  options.tasks(batch.size(), [&](std::size_t i) {
    BakeOptions onOneThread = optionsOf(batch[i]);
    onOneThread.chain.slices = runInOneSlice;
    bake(i, onOneThread, {});
  });
  return baked;
}

/// A mesh as it was written; meshes of equal content share its levels.
struct Written {
  MeshReport report;
  std::vector<int> levelMeshes;  ///< LOD 0 first; empty if the mesh is passed through
  std::vector<float> coverage;
};

/// Writes a mesh and links its levels, or checks one that is passed through.
Written writeMesh(tinygltf::Model& model, std::size_t index, const Before& before, BakedMesh& baked,
                  std::set<int>& finite) {
  if (!baked.report.passedThrough.empty()) {
    requireFinite(model, model.meshes[index], baked.report.passedThrough, finite);
    return {std::move(baked.report), {}, {}};
  }
  tinygltf::Mesh kept = model.meshes[index];
  std::erase_if(kept.primitives, hasTriangles);
  requireFinite(model, kept, "it has no triangles", finite);
  const std::vector<int> levelMeshes = writeLevels(model, index, baked);
  linkNodes(model, before, before.users[index], levelMeshes, baked.coverage);
  return {std::move(baked.report), levelMeshes, std::move(baked.coverage)};
}

/// Writes a mesh whose content equals that of one which is written: only LOD 0 stays a mesh of its own.
Written writeEqual(tinygltf::Model& model, std::size_t index, const Before& before, const Written& first) {
  Written written = first;
  tinygltf::Mesh& mesh = model.meshes[index];
  written.report.name = nameOf(model, index);
  written.report.nodes = before.users[index].size();
  if (written.levelMeshes.empty()) return written;
  const tinygltf::Mesh& finest = model.meshes[static_cast<std::size_t>(first.levelMeshes[0])];
  mesh.primitives = finest.primitives;
  asset::setLodInfo(mesh, first.report.levels[0]);
  const asset::CellTriangles cells = asset::lodCells(model, finest);
  if (!cells.empty()) asset::setLodCells(mesh, cells);
  written.levelMeshes[0] = static_cast<int>(index);
  linkNodes(model, before, before.users[index], written.levelMeshes, written.coverage);
  return written;
}

/// For each mesh the place of the first one that has the same levels.
std::vector<std::size_t> shareLevels(const tinygltf::Model& model, const std::vector<std::size_t>& used,
                                     const Before& before, const std::optional<Budget>& budget) {
  std::vector<std::size_t> first = findEqualMeshes(model, used);
  const auto passes = [&](std::size_t mesh) {
    return !reasonToPass(model, model.meshes[mesh], before.users[mesh], before.isLevel).empty();
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t other = used[first[i]];
    const bool sameBudget = !budget || (budget->targets[used[i]] == budget->targets[other] &&
                                        budget->untilLength[used[i]] == budget->untilLength[other]);
    if (first[i] != i && (!sameBudget || passes(used[i]) || passes(other))) first[i] = i;
  }
  return first;
}

}  // namespace

std::vector<MeshReport> bakeDocument(
    tinygltf::Model& model, const BakeOptions& options,
    const std::function<void(std::size_t, std::size_t, const std::string&)>& progress) {
  checkDemand(model);
  const std::size_t meshes = model.meshes.size();
  Before before{std::vector<std::vector<int>>(meshes), levelNodes(model), indexChannels(model)};
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes[n].mesh >= 0)
      before.users[static_cast<std::size_t>(model.nodes[n].mesh)].push_back(static_cast<int>(n));
  std::vector<std::size_t> used;
  for (std::size_t m = 0; m < meshes; ++m)
    if (!before.users[m].empty()) used.push_back(m);
  progress(0, meshes, "sharing the budget");
  const std::optional<Budget> budget = shareScene(model, used, before, options);
  const auto optionsOf = [&](std::size_t mesh) { return optionsFor(options, budget, mesh); };
  const std::vector<std::size_t> first = shareLevels(model, used, before, budget);
  std::vector<Written> written;
  std::set<int> finite;
  for (std::size_t begin = 0; begin < used.size();) {
    const std::size_t end = batchEnd(model, used, begin);
    progress(used[begin], meshes, model.meshes[used[begin]].name);
    std::vector<std::size_t> different;
    for (std::size_t i = begin; i < end; ++i)
      if (first[i] == i) different.push_back(used[i]);
    std::vector<BakedMesh> baked;
    if (!different.empty())
      baked = bakeBatch(model, different, before, optionsOf,
                        [&](const std::string& what) { progress(used[begin], meshes, what); });
    for (std::size_t next = 0; begin < end; ++begin) {
      written.push_back(named(model, used[begin], [&] {
        return first[begin] == begin ? writeMesh(model, used[begin], before, baked[next++], finite)
                                     : writeEqual(model, used[begin], before, written[first[begin]]);
      }));
    }
  }
  std::vector<MeshReport> reports;
  reports.reserve(written.size());
  for (Written& mesh : written)
    reports.push_back(std::move(mesh.report));
  model.asset.generator = "jalousie-bake";
  return reports;
}

}  // namespace jalousie::bake
