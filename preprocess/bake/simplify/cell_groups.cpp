// A graph of cells whose edges are common vertices, merged greedily; all ties are broken by numbers.
#include "bake/simplify/cell_groups.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "bake/mesh/loose_parts.h"
#include "core/cell_tree.h"

namespace jalousie::bake {
namespace {

constexpr double kLockedBefore = 4.0;   ///< weight of a vertex that was locked in the step before
constexpr double kNearby = 1e-3;        ///< weight of two cells that lie together and share nothing
constexpr std::size_t kMostPaired = 8;  ///< cells at one vertex that are connected with each other

/// Cells as nodes that are joined to groups.
class CellGraph {
 public:
  CellGraph(std::uint32_t cells, std::uint64_t mostTriangles)
      : mostTriangles_(mostTriangles), triangles_(cells, 0), neighbours_(cells), parent_(cells) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  void addTriangle(std::uint32_t cell) { ++triangles_[cell]; }
  void connect(std::uint32_t a, std::uint32_t b, double weight) {
    neighbours_[a][b] += weight;
    neighbours_[b][a] += weight;
  }

  /// Joins until no group has a neighbour that it fits together with.
  void join() {
    using Entry = std::pair<std::uint64_t, std::uint32_t>;  // triangles, group
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::uint32_t cell = 0; cell < parent_.size(); ++cell)
      open.emplace(triangles_[cell], cell);
    while (!open.empty()) {
      const auto [size, group] = open.top();
      open.pop();
      if (parent_[group] != group || triangles_[group] != size) continue;
      const std::uint32_t other = bestNeighbour(group);
      if (other == group) continue;
      merge(std::min(group, other), std::max(group, other));
      open.emplace(triangles_[std::min(group, other)], std::min(group, other));
    }
  }

  /// Numbers the groups in the order of their first cell.
  std::vector<std::uint32_t> groups() const {
    std::vector<std::uint32_t> group(parent_.size());
    std::uint32_t next = 0;
    for (std::uint32_t cell = 0; cell < parent_.size(); ++cell) {
      const std::uint32_t root = rootOf(cell);
      group[cell] = root == cell ? next++ : group[root];  // a root is its group's first cell
    }
    return group;
  }

 private:
  std::uint32_t rootOf(std::uint32_t cell) const {
    while (parent_[cell] != cell)
      cell = parent_[cell];
    return cell;
  }

  /// The neighbour of the largest weight for its size, the first of equals; the group itself if none fits.
  std::uint32_t bestNeighbour(std::uint32_t group) const {
    std::uint32_t best = group;
    double most = 0.0;
    for (const auto& [other, weight] : neighbours_[group]) {
      if (triangles_[group] + triangles_[other] > mostTriangles_) continue;
      const double worth = weight / static_cast<double>(triangles_[other] + 1);
      if (worth <= most) continue;
      most = worth;
      best = other;
    }
    return best;
  }

  /// Joins b to a, which is smaller.
  void merge(std::uint32_t a, std::uint32_t b) {
    parent_[b] = a;
    triangles_[a] += triangles_[b];
    for (const auto& [other, weight] : neighbours_[b]) {
      neighbours_[other].erase(b);
      if (other == a) continue;
      neighbours_[a][other] += weight;
      neighbours_[other][a] += weight;
    }
    neighbours_[b].clear();
  }

  std::uint64_t mostTriangles_;
  std::vector<std::uint64_t> triangles_;
  std::vector<std::map<std::uint32_t, double>> neighbours_;
  std::vector<std::uint32_t> parent_;
};

/// For each vertex the different cells at it, ascending, as ranges of one list.
struct CellsOfVertices {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< vertex, cell

  CellsOfVertices(const WedgeMesh& mesh, std::span<const std::uint32_t> cellOfTriangle) {
    pairs.reserve(mesh.corners.size());
    for (std::size_t c = 0; c < mesh.corners.size(); ++c)
      pairs.emplace_back(mesh.vertexAt(c), cellOfTriangle[c / 3]);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }
  /// Calls visit(pairs of one vertex) for each vertex with several cells.
  template <class Visit>
  void forEachShared(const Visit& visit) const {
    for (std::size_t first = 0; first < pairs.size();) {
      std::size_t end = first + 1;
      while (end < pairs.size() && pairs[end].first == pairs[first].first)
        ++end;
      if (end - first > 1) visit(std::span(pairs).subspan(first, end - first));
      first = end;
    }
  }
};

/// In the middle of the box around the centres of each cell's triangles.
std::vector<glm::vec3> centresOf(const WedgeMesh& mesh, const LevelCells& cells) {
  std::vector<glm::dvec3> sums(cells.count, glm::dvec3(0.0));
  std::vector<std::uint32_t> counts(cells.count, 0);
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    sums[cells.ofTriangle[c / 3]] += glm::dvec3(mesh.positions[mesh.vertexAt(c)]);
    ++counts[cells.ofTriangle[c / 3]];
  }
  std::vector<glm::vec3> centres;
  for (std::uint32_t cell = 0; cell < cells.count; ++cell)
    centres.emplace_back(sums[cell] / static_cast<double>(std::max(counts[cell], 1U)));
  return centres;
}

/// Connects cells that lie together, weakly.
void connectNearby(const WedgeMesh& mesh, const LevelCells& cells, CellGraph& graph) {
  const std::vector<glm::vec3> centres = centresOf(mesh, cells);
  for (const std::uint32_t perLeaf : {kCellsPerGroup, 3 * kCellsPerGroup}) {
    const CellTree tree(centres, perLeaf);
    const CellOrder leaves = orderByCell(tree.assign(centres), tree.cellCount());
    std::uint32_t first = 0;
    for (const std::uint32_t end : leaves.ends) {
      for (std::uint32_t i = first; i < end; ++i)
        for (std::uint32_t j = i + 1; j < std::min(end, i + 3 * kCellsPerGroup); ++j)
          graph.connect(leaves.triangles[i], leaves.triangles[j], kNearby);
      first = end;
    }
  }
}

/// Where a triangle counts for the division into cells: its centroid, or that of its loose part if that is small.
std::vector<glm::vec3> placesOf(const WedgeMesh& mesh, std::uint32_t mostOfPart) {
  std::vector<glm::vec3> places;
  places.reserve(mesh.triangles());
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    places.push_back(triangleCentroid(mesh.positions[mesh.vertexAt(c)], mesh.positions[mesh.vertexAt(c + 1)],
                                      mesh.positions[mesh.vertexAt(c + 2)]));
  const LooseParts parts = findLooseParts(mesh);
  for (const LoosePart& part : parts.parts) {
    if (part.faceCount > mostOfPart) continue;
    const auto faces = std::span(parts.faces).subspan(part.firstFace, part.faceCount);
    glm::dvec3 sum(0.0);
    for (const std::uint32_t face : faces)
      sum += glm::dvec3(places[face]);
    const glm::vec3 middle(sum / static_cast<double>(part.faceCount));
    for (const std::uint32_t face : faces)
      places[face] = middle;
  }
  return places;
}

}  // namespace

std::vector<std::uint32_t> groupCells(const WedgeMesh& mesh, const LevelCells& cells, std::uint32_t trianglesPerCell) {
  CellGraph graph(cells.count, std::uint64_t{kCellsPerGroup} * trianglesPerCell);
  for (const std::uint32_t cell : cells.ofTriangle)
    graph.addTriangle(cell);
  CellsOfVertices(mesh, cells.ofTriangle)
      .forEachShared([&](std::span<const std::pair<std::uint32_t, std::uint32_t>> at) {
        for (std::size_t i = 0; i < at.size(); ++i) {
          for (std::size_t j = i + 1; j < std::min(at.size(), i + kMostPaired); ++j) {
            const bool wasLocked =
                !cells.producerOf.empty() && cells.producerOf[at[i].second] != cells.producerOf[at[j].second];
            graph.connect(at[i].second, at[j].second, wasLocked ? kLockedBefore : 1.0);
          }
        }
      });
  connectNearby(mesh, cells, graph);
  graph.join();
  return graph.groups();
}

std::vector<std::uint8_t> verticesBetween(const WedgeMesh& mesh, std::span<const std::uint32_t> groupOfTriangle) {
  std::vector<std::uint8_t> between(mesh.positions.size(), 0);
  CellsOfVertices(mesh, groupOfTriangle)
      .forEachShared(
          [&](std::span<const std::pair<std::uint32_t, std::uint32_t>> at) { between[at.front().first] = 1; });
  return between;
}

std::vector<std::uint32_t> divideGroups(const WedgeMesh& mesh, std::span<const std::uint32_t> groupOfTriangle,
                                        std::uint32_t trianglesPerCell, std::vector<std::uint32_t>& producerOf) {
  const std::vector<glm::vec3> places = placesOf(mesh, trianglesPerCell / 2);
  const std::uint32_t groups =
      groupOfTriangle.empty() ? 0 : *std::max_element(groupOfTriangle.begin(), groupOfTriangle.end()) + 1;
  const CellOrder order = orderByCell(groupOfTriangle, groups);
  std::vector<std::uint32_t> cellOf(mesh.triangles());
  producerOf.clear();
  std::size_t first = 0;
  for (std::uint32_t group = 0; group < groups; ++group) {
    const auto triangles = std::span(order.triangles).subspan(first, order.ends[group] - first);
    first = order.ends[group];
    if (triangles.empty()) continue;
    std::vector<glm::vec3> own;
    own.reserve(triangles.size());
    for (const std::uint32_t triangle : triangles)
      own.push_back(places[triangle]);
    const CellTree tree(own, trianglesPerCell);
    const std::vector<std::uint32_t> cells = tree.assign(own);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      cellOf[triangles[i]] = static_cast<std::uint32_t>(producerOf.size()) + cells[i];
    producerOf.insert(producerOf.end(), tree.cellCount(), group);
  }
  return cellOf;
}

}  // namespace jalousie::bake
