// Collapses the edge with the least error first; stale queue entries are recognised by the versions of their vertices.
#include "bake/simplify/collapse.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "bake/mesh/bounds.h"
#include "bake/mesh/loose_parts.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/simplify/collapse_checks.h"
#include "bake/simplify/collapse_error.h"
#include "bake/simplify/collapse_queue.h"
#include "bake/simplify/collapse_topology.h"
#include "bake/simplify/part_removal.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kNone = ~0U;

std::vector<glm::dvec3> unitFrame(const WedgeMesh& mesh) {
  const Aabb box = boundsOf(mesh.positions);
  const glm::dvec3 center = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
  const double scale = box.diagonal() > 0.0 ? 1.0 / box.diagonal() : 1.0;
  std::vector<glm::dvec3> positions;
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    positions.push_back((glm::dvec3(p) - center) * scale);
  return positions;
}

}  // namespace

/// What a collapse knows of the mesh. Copies continue independently.
struct EdgeCollapser::Data {
  Data(const WedgeMesh& mesh, const EdgeTable& edges, const CollapseOptions& options)
      : source(mesh),
        positions(unitFrame(mesh)),
        error(mesh, edges, options, positions),
        topology(vertexIndices(mesh), mesh.corners, mesh.positions.size()),
        parts(findLooseParts(mesh)),
        parent(mesh.positions.size()),
        exact(mesh.positions),
        isExact(mesh.positions.size(), 1),
        version(mesh.positions.size(), 0),
        singleWedge(mesh.positions.size(), kNone),
        onBorder(mesh.positions.size(), 0),
        lockedAlways(mesh.positions.size(), 0),
        seen(mesh.positions.size(), 0) {
    std::iota(parent.begin(), parent.end(), 0U);
    const Aabb box = boundsOf(mesh.positions);
    scale = box.diagonal() > 0.0 ? box.diagonal() : 1.0;
    center = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
    classes = classifyParts(mesh, edges, parts, scale);
    removal.emplace(mesh, parts, classes, scale);
    for (const LoosePart& part : parts.parts)
      aliveOfPart.push_back(part.faceCount);
    for (const MeshEdge& edge : edges.edges) {
      if (edge.kind != EdgeKind::kBorder) continue;
      for (const std::uint32_t v : {edge.a, edge.b}) {
        onBorder[v] = 1;
        lockedAlways[v] = options.lockBorder ? 1 : 0;
      }
    }
    for (std::size_t v = 0; v < options.lockedVertices.size(); ++v) {
      if (options.lockedVertices[v] == 0) continue;
      lockedAlways[v] = 1;
      heldParts.resize(parts.parts.size(), 0);
      heldParts[classes.partOfVertex[v]] = 1;
    }
    locked = lockedAlways;
    keptParts = heldParts;
  }

  const WedgeMesh& source;
  std::vector<glm::dvec3> positions;  ///< unit frame
  CollapseError error;
  CollapseTopology topology;
  LooseParts parts;
  PartClasses classes;
  std::optional<PartRemoval> removal;
  std::vector<std::uint32_t> aliveOfPart;  ///< faces
  std::vector<std::uint32_t> parent;       ///< vertex it was merged into
  std::vector<glm::vec3> exact;            ///< its position in object space bit for bit, where isExact
  std::vector<std::uint8_t> isExact;
  std::vector<std::uint32_t> version;      ///< collapses that went into it
  std::vector<std::uint32_t> singleWedge;  ///< its wedge, kNone if it has several
  std::vector<std::uint8_t> onBorder;
  std::vector<std::uint8_t> lockedAlways;  ///< by the options
  std::vector<std::uint8_t> locked;        ///< by the options, or since continueFrom
  std::vector<std::uint32_t> seen, neighbours;
  std::uint32_t generation = 0;
  std::uint32_t removedParts = 0;
  std::vector<CostPoint> costs;
  std::vector<std::uint8_t> heldParts;  ///< with locked vertices; empty: none
  std::vector<std::uint8_t> keptParts;  ///< those and the ones of keepParts
  bool mayRelax = true;                 ///< no vertex is locked since continueFrom
  bool relaxed = false;                 ///< collapses may change the topology
  CollapseQueue queue;
  std::vector<float> values;
  glm::dvec3 center{0.0};
  double scale = 1.0;
};

struct EdgeCollapser::State : Data {
  State(const WedgeMesh& mesh, const EdgeTable& edges, const CollapseOptions& options) : Data(mesh, edges, options) {
    for (std::uint32_t v = 0; v < positions.size(); ++v)
      noteWedges(v);
    fillQueue(edges);
  }
  /// The checks refer to the data of the copy.
  State(const State& other) : Data(other) {}
  State& operator=(const State&) = delete;
  ~State() = default;

  /// Remembers the wedge of a vertex that has just one.
  void noteWedges(std::uint32_t v) {
    std::uint32_t wedge = kNone;
    bool several = false;
    topology.forEachCorner(v, [&](std::uint32_t corner) {
      several = several || (wedge != kNone && wedge != topology.wedgeAt(corner));
      wedge = topology.wedgeAt(corner);
    });
    singleWedge[v] = several ? kNone : wedge;
  }

  void fillQueue(const EdgeTable& edges) {
    for (const MeshEdge& edge : edges.edges)
      if (const auto candidate = assess(edge.a, edge.b)) queue.push(*candidate);
    pushParts();
  }

  void pushParts() {
    for (std::uint32_t p = 0; p < parts.parts.size(); ++p)
      if (p != parts.largest && aliveOfPart[p] > 0) queue.push({costOfRemoval(p), p, kNone, 0});
  }

  /// Takes over places, attributes and locks. @param lockedVertices  of the level
  void adopt(const WedgeMesh& level, std::span<const std::uint8_t> lockedVertices) {
    keptParts = heldParts;
    keptParts.resize(parts.parts.size(), 0);
    std::size_t next = 0;  // corner of the level
    for (std::uint32_t c = 0; c < source.corners.size(); ++c) {
      if (!topology.isAlive(c / 3)) continue;
      const std::uint32_t v = topology.vertexAt(c);
      const std::uint32_t there = level.vertexAt(next);
      exact[v] = level.positions[there];
      isExact[v] = 1;
      positions[v] = (glm::dvec3(exact[v]) - center) / scale;
      error.setAttributes(topology.wedgeAt(c), &level.attributes[std::size_t{level.corners[next]} * level.stride]);
      locked[v] = lockedAlways[v] | lockedVertices[there];
      if (lockedVertices[there] != 0) keptParts[classes.partOfVertex[v]] = 1;
      ++next;
    }
    JAL_CHECK(next == level.corners.size());
  }

  /// Assesses all edges of the current mesh.
  void refillQueue() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t c = 0; c < source.corners.size(); ++c) {
      if (!topology.isAlive(c / 3)) continue;
      const std::uint32_t u = topology.vertexAt(c);
      const std::uint32_t v = topology.vertexAt(CollapseTopology::others(c)[0]);
      edges.emplace_back(std::min(u, v), std::max(u, v));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    queue.clear();
    for (const auto& [u, v] : edges)
      if (const auto candidate = assess(u, v)) queue.push(*candidate);
    pushParts();
  }

  float costOfRemoval(std::uint32_t p) const { return static_cast<float>(removal->cost(p, aliveOfPart)); }

  std::optional<Candidate> assess(std::uint32_t u, std::uint32_t v) {
    if (u > v) std::swap(u, v);
    if (locked[u] != 0 && locked[v] != 0) return std::nullopt;
    WedgeMerge merge;
    if (!checks.gather(u, v, singleWedge, merge)) return std::nullopt;
    const Quadric quadric = error.merged(u, v, merge);
    const std::optional<glm::dvec3> minimum = freeMinimum(u, v, quadric);
    const double cost = minimum ? std::max(quadric.at(*minimum), 0.0) : places(u, v, quadric)[0].cost;
    return Candidate{static_cast<float>(cost), u, v, version[u] + version[v]};
  }

  /// The minimum of the error; nothing if an end is locked or the minimum lies further from the edge's middle than the
  /// edge is long (spikes).
  std::optional<glm::dvec3> freeMinimum(std::uint32_t u, std::uint32_t v, const Quadric& quadric) const {
    if (locked[u] != 0 || locked[v] != 0) return std::nullopt;
    const std::optional<glm::dvec3> minimum = quadric.minimum();
    const glm::dvec3 edge = positions[v] - positions[u];
    if (!minimum) return std::nullopt;
    const glm::dvec3 off = *minimum - 0.5 * (positions[u] + positions[v]);
    return glm::dot(off, off) <= glm::dot(edge, edge) ? minimum : std::nullopt;
  }

  struct Place {
    glm::dvec3 p;
    double cost;
  };
  /// Candidate positions of the new vertex in ascending order of cost: the free minimum, both ends, the middle.
  std::array<Place, 4> places(std::uint32_t u, std::uint32_t v, const Quadric& quadric) const {
    const auto at = [&](const glm::dvec3& p) { return Place{p, std::max(quadric.at(p), 0.0)}; };
    if (locked[u] != 0 || locked[v] != 0) {
      const Place kept = at(locked[u] != 0 ? positions[u] : positions[v]);
      return {kept, kept, kept, kept};
    }
    const glm::dvec3 middle = 0.5 * (positions[u] + positions[v]);
    std::array<Place, 4> result = {at(middle), at(positions[u]), at(positions[v]), at(middle)};
    if (const auto minimum = freeMinimum(u, v, quadric)) result[0] = at(*minimum);
    std::stable_sort(result.begin(), result.end(), [](const Place& a, const Place& b) { return a.cost < b.cost; });
    return result;
  }

  enum class Outcome : std::uint8_t { kDone, kIllegal, kLater };

  Outcome tryCollapse(const Candidate& candidate) {
    const std::uint32_t u = candidate.u;
    const std::uint32_t v = candidate.v;
    if (!relaxed && !topology.canCollapse(u, v, onBorder[u] != 0 && onBorder[v] != 0)) return Outcome::kIllegal;
    if (endsPart(u, v)) return Outcome::kIllegal;
    WedgeMerge merge;
    if (!checks.gather(u, v, singleWedge, merge)) return Outcome::kIllegal;
    const Quadric quadric = error.merged(u, v, merge);
    const glm::dvec3 edge = positions[v] - positions[u];
    const double length2 = glm::dot(edge, edge);
    for (const Place& place : places(u, v, quadric)) {
      if (!checks.keepsFacing(u, v, place.p)) continue;
      const double along = length2 > 0.0 ? std::clamp(glm::dot(place.p - positions[u], edge) / length2, 0.0, 1.0) : 0.5;
      error.attributesAt(place.p, along, merge, values);
      if (!keepLocked(u, v, merge)) return Outcome::kIllegal;
      if (!checks.keepsTexture(u, v, merge, values)) continue;
      const auto cost = static_cast<float>(place.cost);
      if (cost > candidate.cost * 1.0001F) {  // costs more than its queue entry: insert it again
        queue.push({cost, u, v, candidate.version});
        return Outcome::kLater;
      }
      apply(u, v, place.p, merge);
      return Outcome::kDone;
    }
    return Outcome::kIllegal;
  }

  /// Gives each group of wedges the attributes that it has at a locked vertex. False if they differ there.
  bool keepLocked(std::uint32_t u, std::uint32_t v, const WedgeMerge& merge) {
    if (locked[u] == 0 && locked[v] == 0) return true;
    const std::uint8_t side = locked[v] != 0 ? 1 : 0;
    std::array<std::uint32_t, WedgeMerge::kMost> kept;
    kept.fill(kNone);
    for (std::size_t i = 0; i < merge.count; ++i) {
      if (merge.fromV[i] != side) continue;
      std::uint32_t& wedge = kept[merge.group[i]];
      if (wedge != kNone) return false;
      wedge = merge.wedges[i];
      std::copy_n(error.attributes(wedge), source.stride,
                  values.begin() + static_cast<std::ptrdiff_t>(std::size_t{merge.group[i]} * source.stride));
    }
    return true;
  }

  /// Whether the collapse would leave nothing of a loose part, which goes as a whole, at its own cost, or too little of
  /// the mesh.
  bool endsPart(std::uint32_t u, std::uint32_t v) {
    constexpr std::uint32_t kFew = 16;
    const std::uint32_t alive = aliveOfPart[classes.partOfVertex[u]];
    if (alive <= kFew && topology.sharedFaces(u, v) == alive) return true;
    return topology.faces() < kMinLevelTriangles + kFew &&
           topology.faces() < kMinLevelTriangles + topology.sharedFaces(u, v);
  }

  void apply(std::uint32_t u, std::uint32_t v, const glm::dvec3& p, const WedgeMerge& merge) {
    error.commit(u, v, merge, values);
    topology.forEachCorner(u, [&](std::uint32_t corner) {
      const auto [a, b] = CollapseTopology::others(corner);
      if (topology.vertexAt(a) != v && topology.vertexAt(b) != v) return;
      topology.remove(corner / 3);
      const std::uint32_t part = classes.partOfVertex[u];
      if (--aliveOfPart[part] == PartRemoval::kBox && part != parts.largest)
        queue.push({costOfRemoval(part), part, kNone, 0});
    });
    std::array<std::uint32_t, WedgeMerge::kMost> representative;
    representative.fill(kNone);
    for (std::size_t i = 0; i < merge.count; ++i)
      if (representative[merge.group[i]] == kNone) representative[merge.group[i]] = merge.wedges[i];
    for (const std::uint32_t vertex : {u, v}) {
      topology.forEachCorner(vertex, [&](std::uint32_t corner) {
        std::size_t i = 0;
        while (merge.wedges[i] != topology.wedgeAt(corner))
          ++i;
        topology.setWedge(corner, representative[merge.group[i]]);
      });
    }
    topology.merge(u, v);
    if (p != positions[u]) {
      isExact[u] = p == positions[v] ? isExact[v] : 0;
      exact[u] = exact[v];
    }
    positions[u] = p;
    parent[v] = u;
    onBorder[u] = onBorder[u] | onBorder[v];
    lockedAlways[u] = lockedAlways[u] | lockedAlways[v];
    locked[u] = locked[u] | locked[v];
    ++version[u];
    version[v] = kNone / 2;  // no sum with it matches a queued version
    noteWedges(u);
    ++generation;
    topology.forEachCorner(u, [&](std::uint32_t corner) {
      for (const std::uint32_t other : CollapseTopology::others(corner)) {
        const std::uint32_t n = topology.vertexAt(other);
        if (seen[n] == generation) continue;
        seen[n] = generation;
        neighbours.push_back(n);
      }
    });
    for (const std::uint32_t n : neighbours)
      if (const auto candidate = assess(u, n)) queue.push(*candidate);
    neighbours.clear();
  }

  /// Removes a loose part unless fewer than `least` triangles would remain.
  Outcome removePart(std::uint32_t p, float cost, std::uint32_t least) {
    const LoosePart& part = parts.parts[p];
    if (!keptParts.empty() && keptParts[p] != 0) return Outcome::kIllegal;
    if (aliveOfPart[p] == 0) return Outcome::kLater;  // its entries in the queue outlive it
    if (topology.faces() - aliveOfPart[p] < least) return Outcome::kIllegal;
    if (const float now = costOfRemoval(p); now > cost * 1.0001F) {
      queue.push({now, p, kNone, 0});
      return Outcome::kLater;
    }
    for (const std::uint32_t face : std::span(parts.faces).subspan(part.firstFace, part.faceCount)) {
      if (!topology.isAlive(face)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = topology.vertexAt(3 * face + k);
        version[v] = kNone / 2;
      }
      topology.remove(face);
    }
    aliveOfPart[p] = 0;
    ++removedParts;
    return Outcome::kDone;
  }

  bool isStale(const Candidate& candidate) const {
    return candidate.v != kNone && version[candidate.u] + version[candidate.v] != candidate.version;
  }

  /// Points are 2 % apart.
  void noteCost(double cost) {
    if (costs.empty() || cost > 1.02 * costs.back().cost) {
      costs.push_back({topology.faces(), cost});
    } else {
      costs.back().triangles = topology.faces();
    }
  }

  void run(std::uint32_t target) {
    std::uint32_t least = std::max(kMinLevelTriangles, target - target / 20);
    relaxed = false;
    std::vector<Candidate> waiting;  // illegal now; retried after their surroundings have changed
    std::uint32_t facesAtRetry = topology.faces();
    while (topology.faces() > target) {
      if (queue.empty()) {
        const bool stuck = topology.faces() == facesAtRetry;
        if (waiting.empty() || (stuck && (relaxed || !mayRelax))) break;
        // Nothing legal is left: from here on the level may change its topology and have fewer triangles than asked.
        if (stuck) relaxed = true, least = kMinLevelTriangles;
        facesAtRetry = topology.faces();
        for (const Candidate& candidate : waiting)
          queue.push(candidate);
        waiting.clear();
        continue;
      }
      const Candidate candidate = queue.pop();
      if (isStale(candidate)) continue;
      const Outcome outcome =
          candidate.v == kNone ? removePart(candidate.u, candidate.cost, least) : tryCollapse(candidate);
      if (outcome == Outcome::kIllegal) waiting.push_back(candidate);
      if (outcome == Outcome::kDone) noteCost(double{candidate.cost});
    }
    for (const Candidate& candidate : waiting)
      queue.push(candidate);
  }

  CollapseChecks checks{source, positions, error, topology};
};

EdgeCollapser::EdgeCollapser(const WedgeMesh& mesh, const CollapseOptions& options)
    : state_(std::make_unique<State>(mesh, findEdges(mesh), options)) {}
EdgeCollapser::EdgeCollapser(const EdgeCollapser& other) : state_(std::make_unique<State>(*other.state_)) {}
EdgeCollapser::~EdgeCollapser() = default;

void EdgeCollapser::collapseTo(std::uint32_t target) {
  state_->run(std::max(target, kMinLevelTriangles));
}

void EdgeCollapser::keepParts(std::span<const std::uint8_t> keep) {
  JAL_CHECK((keep.empty() || keep.size() == state_->parts.parts.size()));
  std::vector<std::uint8_t>& kept = state_->keptParts;
  kept = state_->heldParts;
  kept.resize(std::max(kept.size(), keep.size()), 0);
  for (std::size_t p = 0; p < keep.size(); ++p)
    kept[p] = kept[p] | keep[p];
}

void EdgeCollapser::continueFrom(const WedgeMesh& level, std::span<const std::uint8_t> lockedVertices) {
  JAL_CHECK(lockedVertices.size() == level.positions.size());
  state_->adopt(level, lockedVertices);
  state_->mayRelax = std::find(lockedVertices.begin(), lockedVertices.end(), 1) == lockedVertices.end();
  state_->refillQueue();
}

std::vector<std::uint32_t> EdgeCollapser::sourceTriangles() const {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(state_->topology.faces());
  for (std::uint32_t face = 0; face < state_->source.triangles(); ++face)
    if (state_->topology.isAlive(face)) triangles.push_back(face);
  return triangles;
}

std::uint32_t EdgeCollapser::triangles() const {
  return state_->topology.faces();
}

WedgeMesh EdgeCollapser::mesh() const {
  const State& state = *state_;
  WedgeMesh mesh;
  mesh.slots = state.source.slots;
  mesh.stride = state.source.stride;
  std::vector<std::uint32_t> vertexAt(state.positions.size(), kNone);
  std::vector<std::uint32_t> wedgeAt(state.source.vertexOf.size(), kNone);
  for (std::uint32_t c = 0; c < state.source.corners.size(); ++c) {
    if (!state.topology.isAlive(c / 3)) continue;
    const std::uint32_t v = state.topology.vertexAt(c);
    const std::uint32_t w = state.topology.wedgeAt(c);
    if (vertexAt[v] == kNone) {
      vertexAt[v] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(state.isExact[v] != 0 ? state.exact[v]
                                                     : glm::vec3(state.center + state.scale * state.positions[v]));
    }
    if (wedgeAt[w] == kNone) {
      wedgeAt[w] = static_cast<std::uint32_t>(mesh.vertexOf.size());
      mesh.vertexOf.push_back(vertexAt[v]);
      mesh.primitiveOf.push_back(state.source.primitiveOf[w]);
      mesh.sourceWedge.push_back(w);
      mesh.attributes.insert(mesh.attributes.end(), state.error.attributes(w), state.error.attributes(w) + mesh.stride);
    }
    mesh.corners.push_back(wedgeAt[w]);
  }
  return mesh;
}

const std::vector<CostPoint>& EdgeCollapser::costs() const {
  return state_->costs;
}

std::uint32_t EdgeCollapser::removedParts() const {
  return state_->removedParts;
}

const PartClasses& EdgeCollapser::partClasses() const {
  return state_->classes;
}

std::vector<std::uint32_t> EdgeCollapser::vertexMap() const {
  const State& state = *state_;
  std::vector<std::uint32_t> compact(state.positions.size(), kGone);
  std::uint32_t next = 0;
  for (std::uint32_t c = 0; c < state.source.corners.size(); ++c) {
    if (!state.topology.isAlive(c / 3)) continue;
    std::uint32_t& index = compact[state.topology.vertexAt(c)];
    if (index == kGone) index = next++;
  }
  std::vector<std::uint32_t> map(state.positions.size());
  for (std::uint32_t v = 0; v < map.size(); ++v) {
    std::uint32_t root = v;
    while (state.parent[root] != root)
      root = state.parent[root];
    map[v] = compact[root];
  }
  return map;
}

}  // namespace jalousie::bake
