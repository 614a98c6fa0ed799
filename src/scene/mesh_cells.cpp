// Chains share the room for cells: where it is short, those with the most get fewer and larger cells.
#include "scene/mesh_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/cell_tree.h"
#include "core/error.h"
#include "scene/motion_data.h"

namespace jalousie::scene {
namespace {

using asset::Mesh;
using asset::Primitive;

std::uint64_t trianglesOf(const Mesh& mesh) {
  std::uint64_t indices = 0;
  for (const Primitive& primitive : mesh.primitives)
    indices += primitive.indices.size();
  return indices / 3;
}

/// Cells that the file itself divides a mesh into; 0: none.
std::uint32_t storedCells(const Mesh& mesh) {
  return mesh.primitives.empty() ? 0 : static_cast<std::uint32_t>(mesh.primitives.front().cellEnds.size());
}

std::vector<glm::vec3> centroidsOf(const Mesh& mesh) {
  std::vector<glm::vec3> centroids;
  centroids.reserve(trianglesOf(mesh));
  for (const Primitive& primitive : mesh.primitives) {
    const auto corner = [&](std::size_t i) { return primitive.positions[primitive.indices[i]]; };
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
      centroids.push_back(triangleCentroid(corner(i), corner(i + 1), corner(i + 2)));
  }
  return centroids;
}

/// Puts the triangles of one primitive in the order of their cells. @param cells  per triangle of the primitive
void sortByCell(const Primitive& primitive, std::span<const std::uint32_t> cells, MeshCells& result) {
  const CellOrder order = orderByCell(cells, result.count);
  std::vector<std::uint32_t> indices;
  indices.reserve(primitive.indices.size());
  for (const std::uint32_t triangle : order.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      indices.push_back(primitive.indices[3 * std::size_t{triangle} + k]);
  std::vector<std::uint32_t> ends = order.ends;
  for (std::uint32_t& end : ends)
    end *= 3;
  result.indices.push_back(std::move(indices));
  result.ends.push_back(std::move(ends));
}

MeshCells divide(const Mesh& mesh, const CellTree& tree) {
  MeshCells result;
  result.count = tree.cellCount();
  const std::vector<std::uint32_t> cells = tree.assign(centroidsOf(mesh));
  std::size_t first = 0;
  for (const Primitive& primitive : mesh.primitives) {
    const std::size_t triangles = primitive.indices.size() / 3;
    sortByCell(primitive, std::span(cells).subspan(first, triangles), result);
    first += triangles;
  }
  return result;
}

MeshCells stored(const Mesh& mesh) {
  MeshCells result;
  result.count = storedCells(mesh);
  result.indices.resize(mesh.primitives.size());
  for (const Primitive& primitive : mesh.primitives)
    result.ends.push_back(primitive.cellEnds);
  return result;
}

/// Makes one cell of each `join` neighbours in their order. A coarse level, whose triangles are spread over few of
/// them, remains divided.
void joinNeighbours(MeshCells& cells, std::uint64_t join) {
  cells.count = static_cast<std::uint32_t>((cells.count + join - 1) / join);
  for (std::vector<std::uint32_t>& ends : cells.ends) {
    std::vector<std::uint32_t> joined;
    for (std::uint64_t cell = 1; cell <= cells.count; ++cell)
      joined.push_back(ends[std::min<std::uint64_t>(cell * join, ends.size()) - 1]);
    ends = std::move(joined);
  }
}

/// What each may have of `room` so that none gets more than it wants, and no one's wish is cut before a larger one's.
/// @return  the most that one gets
std::uint64_t fairShare(std::vector<std::uint64_t> wishes, std::uint64_t room) {
  std::sort(wishes.begin(), wishes.end());
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const std::uint64_t share = room / (wishes.size() - i);
    if (wishes[i] > share) return share;
    room -= wishes[i];
  }
  return wishes.empty() ? room : wishes.back();
}

/// Chooses and divides for one file.
class Division {
 public:
  Division(const asset::SceneFile& file, const CellOptions& options)
      : file_(file), options_(options), cells_(file.meshes.size()), instances_(file.chains.size()) {
    for (const asset::Instance& instance : file.instances)
      ++instances_[instance.chain];
    usedBy_.resize(file.meshes.size());
    bent_ = bentMeshes(file);
    for (const asset::Chain& chain : file.chains) {
      for (std::size_t k = 0; k < chain.levels.size(); ++k) {
        const auto known = std::find_if(chain.levels.begin(), chain.levels.begin() + static_cast<std::ptrdiff_t>(k),
                                        [&](const asset::LodLevel& l) { return l.mesh == chain.levels[k].mesh; });
        if (known == chain.levels.begin() + static_cast<std::ptrdiff_t>(k)) ++usedBy_[chain.levels[k].mesh];
      }
    }
  }

  std::vector<MeshCells> run() {
    std::vector<Candidate> candidates;
    for (std::size_t chain = 0; chain < file_.chains.size(); ++chain) {
      const Candidate candidate = candidateOf(chain);
      if (instances_[chain] > 0 && candidate.cells > 1) candidates.push_back(candidate);
    }
    shareRoom(candidates);
    for (const Candidate& candidate : candidates)
      divideChain(candidate);
    return std::move(cells_);
  }

 private:
  /// A chain that can be divided.
  struct Candidate {
    std::size_t chain;
    std::uint64_t cells;    ///< of one instance
    bool fromFile;          ///< the cells are those of the file, else the chain is cut
    std::uint64_t allowed;  ///< of one instance, at most; or kAll
  };
  static constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

  bool automatic() const { return options_.kind == CellOptions::Kind::kAutomatic; }
  const Mesh& finest(std::size_t chain) const { return file_.meshes[file_.chains[chain].levels.front().mesh]; }

  /// The boxes of cells would have to follow the pose: a bent mesh is one cell.
  bool isBent(std::size_t chain) const {
    const std::vector<asset::LodLevel>& levels = file_.chains[chain].levels;
    return std::any_of(levels.begin(), levels.end(), [&](const asset::LodLevel& level) { return bent_[level.mesh]; });
  }

  Candidate candidateOf(std::size_t chain) const {
    if (isBent(chain)) return {chain, 1, false, kAll};
    const std::uint32_t fromFile = automatic() ? storedCells(finest(chain)) : 0;
    if (fromFile > 0) return {chain, fromFile, true, kAll};
    const std::uint64_t triangles = trianglesOf(finest(chain));
    const std::uint64_t least = automatic() ? 2 : 1;
    if (triangles <= least * options_.trianglesPerCell || sharesMeshes(chain)) return {chain, 1, false, kAll};
    const std::uint64_t cells = (triangles + options_.trianglesPerCell - 1) / options_.trianglesPerCell;
    return {chain, cells, false, kAll};
  }

  /// Sets what each chain may have; those that may not have two cells for each instance are left out, and the others
  /// share their room. Errors: kLimit unless automatic.
  void shareRoom(std::vector<Candidate>& candidates) const {
    std::size_t before = 0;
    do {
      before = candidates.size();
      std::vector<std::uint64_t> wishes;
      wishes.reserve(before);
      for (const Candidate& candidate : candidates)
        wishes.push_back(candidate.cells * instances_[candidate.chain]);
      const std::uint64_t share = fairShare(wishes, automatic() ? kMostAutomaticCells : kMostCells);
      for (Candidate& candidate : candidates) {
        const bool all = candidate.cells * instances_[candidate.chain] <= share;
        candidate.allowed = all ? kAll : share / instances_[candidate.chain];
      }
      if (!automatic()) return requireAll(candidates);
      std::erase_if(candidates, [&](const Candidate& candidate) {
        return candidate.allowed < 2 || (candidate.allowed != kAll && sharesMeshes(candidate.chain));
      });
    } while (candidates.size() < before);
  }

  void requireAll(std::span<const Candidate> candidates) const {
    for (const Candidate& candidate : candidates) {
      if (candidate.allowed != kAll)
        throw Error(ErrorCode::kLimit, fmt::format("cells of {} triangles would be more than {} in the whole scene; "
                                                   "give --cells a larger number, or auto",
                                                   options_.trianglesPerCell, kMostCells));
    }
  }

  void divideChain(const Candidate& candidate) {
    std::optional<CellTree> tree;
    std::uint64_t count = candidate.cells;
    if (!candidate.fromFile) {
      tree.emplace(centroidsOf(finest(candidate.chain)), options_.trianglesPerCell);
      count = tree->cellCount();  // a cell is at least half full
    }
    const std::uint64_t join = candidate.allowed == kAll ? 1 : (count + candidate.allowed - 1) / candidate.allowed;
    if (count <= join) return;
    for (const asset::LodLevel& level : file_.chains[candidate.chain].levels) {
      const Mesh& mesh = file_.meshes[level.mesh];
      cells_[level.mesh] = tree ? divide(mesh, *tree) : stored(mesh);
      if (join > 1) joinNeighbours(cells_[level.mesh], join);
    }
  }

  bool sharesMeshes(std::size_t chain) const {
    const std::vector<asset::LodLevel>& levels = file_.chains[chain].levels;
    return std::any_of(levels.begin(), levels.end(),
                       [&](const asset::LodLevel& level) { return usedBy_[level.mesh] > 1; });
  }

  const asset::SceneFile& file_;
  const CellOptions& options_;
  std::vector<MeshCells> cells_;
  std::vector<std::uint64_t> instances_;  ///< per chain
  std::vector<std::uint32_t> usedBy_;     ///< per mesh: number of chains
  std::vector<bool> bent_;                ///< per mesh: whether animations bend it
};

}  // namespace

std::vector<MeshCells> divideMeshes(const asset::SceneFile& file, const CellOptions& options) {
  if (options.kind == CellOptions::Kind::kOff) return std::vector<MeshCells>(file.meshes.size());
  return Division(file, options).run();
}

}  // namespace jalousie::scene
