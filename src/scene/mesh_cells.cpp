// Chains in the order of what they can gain: the largest first, as long as there is room for their cells.
#include "scene/mesh_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "asset/cell_tree.h"
#include "core/error.h"

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
      centroids.push_back(asset::triangleCentroid(corner(i), corner(i + 1), corner(i + 2)));
  }
  return centroids;
}

/// Puts the triangles of one primitive in the order of their cells. @param cells  per triangle of the primitive
void sortByCell(const Primitive& primitive, std::span<const std::uint32_t> cells, MeshCells& result) {
  const asset::CellOrder order = asset::orderByCell(cells, result.count);
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

MeshCells divide(const Mesh& mesh, const asset::CellTree& tree) {
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

/// Chooses and divides for one file.
class Division {
 public:
  Division(const asset::SceneFile& file, const CellOptions& options)
      : file_(file), options_(options), cells_(file.meshes.size()), instances_(file.chains.size()) {
    for (const asset::Instance& instance : file.instances)
      ++instances_[instance.chain];
    usedBy_.resize(file.meshes.size());
    for (const asset::Chain& chain : file.chains) {
      for (std::size_t k = 0; k < chain.levels.size(); ++k) {
        const auto known = std::find_if(chain.levels.begin(), chain.levels.begin() + static_cast<std::ptrdiff_t>(k),
                                        [&](const asset::LodLevel& l) { return l.mesh == chain.levels[k].mesh; });
        if (known == chain.levels.begin() + static_cast<std::ptrdiff_t>(k)) ++usedBy_[chain.levels[k].mesh];
      }
    }
  }

  std::vector<MeshCells> run() {
    std::vector<std::size_t> order(file_.chains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return finestTriangles(a) > finestTriangles(b); });
    for (const std::size_t chain : order)
      if (instances_[chain] > 0) divideChain(chain);
    return std::move(cells_);
  }

 private:
  const Mesh& finest(std::size_t chain) const { return file_.meshes[file_.chains[chain].levels.front().mesh]; }
  std::uint64_t finestTriangles(std::size_t chain) const { return trianglesOf(finest(chain)); }

  void divideChain(std::size_t chain) {
    const std::uint32_t fromFile = options_.kind == CellOptions::Kind::kAutomatic ? storedCells(finest(chain)) : 0;
    if (fromFile > 1) {
      if (!takeRoom(fromFile * instances_[chain])) return;
      for (const asset::LodLevel& level : file_.chains[chain].levels)
        cells_[level.mesh] = stored(file_.meshes[level.mesh]);
      return;
    }
    const std::uint64_t triangles = finestTriangles(chain);
    const std::uint64_t least = options_.kind == CellOptions::Kind::kAutomatic ? 2 : 1;
    if (fromFile == 1 || triangles <= least * options_.trianglesPerCell || sharesMeshes(chain)) return;
    const std::uint64_t expected = (triangles + options_.trianglesPerCell - 1) / options_.trianglesPerCell;
    if (!takeRoom(expected * instances_[chain])) return;
    const asset::CellTree tree(centroidsOf(finest(chain)), options_.trianglesPerCell);
    if (tree.cellCount() == 1) return;
    for (const asset::LodLevel& level : file_.chains[chain].levels)
      cells_[level.mesh] = divide(file_.meshes[level.mesh], tree);
  }

  bool sharesMeshes(std::size_t chain) const {
    const std::vector<asset::LodLevel>& levels = file_.chains[chain].levels;
    return std::any_of(levels.begin(), levels.end(),
                       [&](const asset::LodLevel& level) { return usedBy_[level.mesh] > 1; });
  }

  /// Whether the scene may have so many cells more. Errors: kLimit.
  bool takeRoom(std::uint64_t cells) {
    const bool automatic = options_.kind == CellOptions::Kind::kAutomatic;
    if (total_ + cells <= (automatic ? kMostAutomaticCells : kMostCells)) {
      total_ += cells;
      return true;
    }
    if (automatic) return false;
    throw Error(ErrorCode::kLimit, fmt::format("cells of {} triangles would be more than {} in the whole scene; give "
                                               "--cells a larger number, or auto",
                                               options_.trianglesPerCell, kMostCells));
  }

  const asset::SceneFile& file_;
  const CellOptions& options_;
  std::vector<MeshCells> cells_;
  std::vector<std::uint64_t> instances_;  ///< per chain
  std::vector<std::uint32_t> usedBy_;     ///< per mesh: number of chains
  std::uint64_t total_ = 0;
};

}  // namespace

std::vector<MeshCells> divideMeshes(const asset::SceneFile& file, const CellOptions& options) {
  if (options.kind == CellOptions::Kind::kOff) return std::vector<MeshCells>(file.meshes.size());
  return Division(file, options).run();
}

}  // namespace jalousie::scene
