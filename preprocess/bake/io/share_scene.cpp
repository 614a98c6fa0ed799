// Locks vertices that meshes share, runs every collapse to its end, and cuts all of them at common costs.
#include "bake/io/share_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asset/instancing.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/link_levels.h"
#include "bake/io/node_scales.h"
#include "bake/io/touching_meshes.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/simplify/chain.h"
#include "bake/simplify/scene_budget.h"

namespace jalousie::bake {
namespace {

/// Forbids to leave meshes out that are no details of the scene. @param stays  of each mesh: must be shown anyway
void keepMeshes(std::span<BudgetMesh> budgets, const std::vector<bool>& stays, double largest,
                const ChainOptions& options) {
  const double most = 0.01 * options.untilError * largest;
  const bool none = options.untilTriangles.value_or(0) > kMinLevelTriangles;
  for (std::size_t m = 0; m < budgets.size(); ++m) {
    const bool isDetail = budgets[m].diagonal <= most && budgets[m].diagonal < largest;
    if (!isDetail || stays[m] || none) budgets[m].removal = std::numeric_limits<double>::infinity();
  }
}

/// For each node whether an animation changes its size, or that of a node above it.
std::vector<bool> growingNodes(const tinygltf::Model& model) {
  std::vector<bool> grows(model.nodes.size(), false);
  std::vector<int> open;
  for (const tinygltf::Animation& animation : model.animations)
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      if (channel.target_path == "scale" && channel.target_node >= 0) open.push_back(channel.target_node);
  for (const int node : indexChannels(model).pointed)
    if (static_cast<std::size_t>(node) < model.nodes.size()) open.push_back(node);
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (grows[node]) continue;
    grows[node] = true;
    open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
  }
  return grows;
}

/// How often a node shows its mesh, and the largest scale of its instances.
struct Shown {
  std::uint64_t times = 1;
  double scale = 1.0;
};

Shown shownBy(const tinygltf::Model& model, int node, const asset::Limits& limits) {
  Shown shown;
  const asset::InstanceTransforms instances = asset::readInstances(model, node, limits);
  if (instances.count == 0) return shown;
  shown.times = instances.count;
  shown.scale = 0.0;
  for (const glm::vec3& scale : instances.values.scales)
    shown.scale = std::max(shown.scale, std::cbrt(std::abs(double{scale.x} * double{scale.y} * double{scale.z})));
  return shown;
}

/// For each mesh whether it has to stay: others touch it, an animation may enlarge it, or a level that shows nothing
/// would take its points and lines along.
std::vector<bool> stayingMeshes(const tinygltf::Model& model, std::span<const std::size_t> used, const MeshUse& use,
                                std::span<const std::vector<glm::vec3>> touching) {
  const std::vector<bool> grows = growingNodes(model);
  std::vector<bool> stays(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::vector<tinygltf::Primitive>& primitives = model.meshes[used[i]].primitives;
    const std::vector<int>& nodes = use.users[used[i]];
    stays[i] = !touching[i].empty() || !std::all_of(primitives.begin(), primitives.end(), hasTriangles) ||
               std::any_of(nodes.begin(), nodes.end(), [&](int node) { return grows[static_cast<std::size_t>(node)]; });
  }
  return stays;
}

/// What a mesh offers, and the positions of its open borders.
struct Offer {
  BudgetMesh budget;
  std::vector<glm::vec3> border;
};

/// @param scale  see nodeScales
Offer offerOf(const tinygltf::Model& model, std::size_t index, const MeshUse& use, const BakeOptions& options,
              double scale) {
  Offer offer;
  BudgetMesh& budget = offer.budget;
  const PreparedMesh prepared = prepareMesh(model, index, use, options);
  if (!prepared.wedges) return offer;
  const WedgeMesh& wedges = *prepared.wedges;
  offer.border = borderPositions(wedges, findEdges(wedges));
  budget.triangles = wedges.triangles();
  budget.diagonal = scale * prepared.report.diagonal;
  if (!options.chain.errors.empty()) return offer;  // each mesh reaches them by itself
  ChainOptions chain = options.chain;
  chain.collapse.lockedVertices = verticesAt(wedges, options.locked);
  CostCurve curve = costCurve(wedges, chain);
  budget.unseen = curve.unseen;
  budget.removal = curve.removal * scale * scale * scale * scale;
  budget.costs = std::move(curve.points);
  for (CostPoint& point : budget.costs)
    point.cost *= scale * scale * scale * scale;
  return offer;
}

}  // namespace

bool sharesBudget(const BakeOptions& options, std::span<const std::size_t> used) {
  return options.sceneBudget && used.size() > 1 && options.chain.preset != Preset::kDraft;
}

SceneShare shareScene(const tinygltf::Model& model, std::span<const std::size_t> used, const MeshUse& use,
                      const BakeOptions& options) {
  const std::vector<glm::dmat4> transforms = worldTransforms(model);
  const std::vector<double> scales = nodeScales(model);
  std::vector<double> scaleOf(used.size(), 0.0);
  std::vector<std::uint64_t> times(used.size(), 0);
  std::vector<MeshBorder> borders(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (const int node : use.users[used[i]]) {
      const Shown shown = shownBy(model, node, options.limits);
      times[i] += shown.times;
      scaleOf[i] = std::max(scaleOf[i], scales[static_cast<std::size_t>(node)] * shown.scale);
      borders[i].transforms.push_back(transforms[static_cast<std::size_t>(node)]);
    }
  }
  std::vector<BudgetMesh> budgets(used.size());
  const auto ask = [&](std::size_t i, const BakeOptions& own) {
    Offer offer = named(model, used[i], [&] { return offerOf(model, used[i], use, own, scaleOf[i]); });
    budgets[i] = std::move(offer.budget);
    budgets[i].nodes = times[i];
    borders[i].places = std::move(offer.border);
  };
  options.tasks(used.size(), [&](std::size_t i) { ask(i, options); });
  std::vector<std::vector<glm::vec3>> touching = touchingPlaces(borders);
  options.tasks(used.size(), [&](std::size_t i) {  // again, with vertices that stay
    if (touching[i].empty()) return;
    BakeOptions own = options;
    own.locked = touching[i];
    ask(i, own);
  });
  double largest = 0.0;
  for (const BudgetMesh& budget : budgets)
    largest = std::max(largest, budget.diagonal);
  keepMeshes(budgets, stayingMeshes(model, used, use, touching), largest, options.chain);
  std::vector<std::vector<std::uint32_t>> targets(used.size());
  if (options.chain.errors.empty()) targets = shareBudget(budgets, options.chain);
  const std::size_t meshes = model.meshes.size();
  SceneShare share{std::vector<std::vector<std::uint32_t>>(meshes), std::vector<double>(meshes, 0.0),
                   std::vector<std::vector<glm::vec3>>(meshes)};
  for (std::size_t i = 0; i < used.size(); ++i) {
    share.touching[used[i]] = std::move(touching[i]);
    share.targets[used[i]] = std::move(targets[i]);
    // Small meshes may err by more than their own size allows: what counts is the largest mesh.
    share.reference[used[i]] = scaleOf[i] > 0.0 ? largest / scaleOf[i] : 0.0;
  }
  return share;
}

BakeOptions optionsInScene(const BakeOptions& options, const SceneShare& share, std::size_t mesh) {
  BakeOptions own = options;
  own.locked = share.touching[mesh];
  own.chain.reference = share.reference[mesh];
  if (!own.chain.errors.empty()) return own;
  own.chain.isShare = true;
  own.chain.targets = share.targets[mesh];
  own.chain.leftOut = !own.chain.targets.empty() && own.chain.targets.back() == 0;
  if (own.chain.leftOut) own.chain.targets.pop_back();
  own.chain.ratios.clear();
  own.chain.coarsest.reset();
  if (own.chain.targets.empty()) own.chain.levels = 1;
  return own;
}

}  // namespace jalousie::bake
