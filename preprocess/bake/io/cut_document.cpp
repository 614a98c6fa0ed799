// Primitives of a cut share the vertex accessors of their levels and have index lists of their own.
#include "bake/io/cut_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "asset/accessor.h"
#include "asset/cell_cut.h"
#include "asset/lod_chain.h"
#include "asset/triangle_count.h"
#include "bake/io/node_scales.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr const char* kChain = "MSFT_lod";
constexpr const char* kInstances = "EXT_mesh_gpu_instancing";

/// Triangles of one primitive of a level, cell by cell.
struct PrimitiveCells {
  const tinygltf::Primitive* source = nullptr;
  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> ends;  ///< behind the indices of each cell
};

struct LevelToCut {
  std::vector<PrimitiveCells> primitives;
  std::vector<Aabb> boxes;  ///< of cells
  double error = 0.0;       ///< object-space length: the stored one, or the mean
  std::uint64_t triangles = 0;
};

const tinygltf::Mesh& meshOf(const tinygltf::Model& model, int node) {
  return model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(node)].mesh)];
}

PrimitiveCells readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& source,
                             const std::vector<std::uint32_t>& cells, const CutOptions& options,
                             std::vector<Aabb>& boxes) {
  PrimitiveCells result;
  result.source = &source;
  if (asset::triangleCount(model, source) == 0) return result;
  if (source.mode != TINYGLTF_MODE_TRIANGLES && source.mode != -1)
    throw Error(ErrorCode::kUnsupported, "a level with cells has strips or fans; bake the mesh again");
  const std::vector<glm::vec3> positions =
      asset::readVec3(model, source.attributes.at("POSITION"), options.limits.maxAccessorElements);
  const auto vertices = static_cast<std::uint32_t>(positions.size());
  if (source.indices >= 0) {
    result.indices = asset::readIndices(model, source.indices, vertices, options.limits.maxAccessorElements);
  } else {
    result.indices.resize(vertices);
    std::iota(result.indices.begin(), result.indices.end(), 0U);
  }
  std::size_t at = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::size_t end = at + 3 * std::size_t{cells[cell]};
    for (; at < end; ++at)
      if (cell < boxes.size()) boxes[cell].add(positions[result.indices[at]]);
    result.ends.push_back(end);
  }
  return result;
}

LevelToCut readLevel(const tinygltf::Model& model, int node, std::uint32_t cellCount, const CutOptions& options) {
  const tinygltf::Mesh& mesh = meshOf(model, node);
  const asset::CellTriangles cells = asset::lodCells(model, mesh);
  LevelToCut level;
  level.boxes.resize(cellCount);
  const asset::LodInfo info = *asset::lodInfo(mesh);  // a mesh with groups has all measures
  level.error = options.by == asset::CutBy::kMean ? info.measures->twoSided.mean : info.errorObject;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    level.primitives.push_back(readPrimitive(model, mesh.primitives[p], cells[p], options, level.boxes));
    level.triangles += asset::triangleCount(model, mesh.primitives[p]);
  }
  return level;
}

/// The largest scale of a transform over its least one; with shear a bound of that.
double distortion(const glm::dmat3& linear) {
  const glm::dvec3 lengths(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
  const glm::dvec3 between(glm::dot(linear[0], linear[1]) / (lengths[0] * lengths[1]),
                           glm::dot(linear[1], linear[2]) / (lengths[1] * lengths[2]),
                           glm::dot(linear[2], linear[0]) / (lengths[2] * lengths[0]));
  constexpr double kStraight = 1e-6;
  if (glm::length(between) < kStraight)
    return std::max({lengths[0], lengths[1], lengths[2]}) / std::min({lengths[0], lengths[1], lengths[2]});
  const glm::dmat3 back = glm::inverse(linear);
  return glm::length(lengths) *
         glm::length(glm::dvec3(glm::length(back[0]), glm::length(back[1]), glm::length(back[2])));  // Frobenius norms
}

/// The eye and the limit in the space of a node's mesh.
struct ObjectView {
  glm::dvec3 eye{0.0};
  double slope = 0.0;
};

/// @return  nullopt if the transform cannot be inverted
std::optional<ObjectView> viewOf(const glm::dmat4& world, const CutOptions& options) {
  const glm::dmat4 inverse = glm::inverse(world);
  const glm::dvec3 eye(inverse * glm::dvec4(*options.eye, 1.0));
  const double slope = 2.0 * options.pixels * std::tan(options.fieldOfView * std::numbers::pi / 360.0) / options.height;
  const ObjectView view{eye, slope / distortion(glm::dmat3(world))};
  const bool isFinite = std::isfinite(eye.x + eye.y + eye.z) && std::isfinite(view.slope) && view.slope > 0.0;
  return isFinite ? std::optional(view) : std::nullopt;
}

/// The triangles of the drawn cells of one level's primitive.
std::vector<std::uint32_t> drawnIndices(const PrimitiveCells& primitive, const std::vector<std::uint8_t>& drawn) {
  std::vector<std::uint32_t> indices;
  for (std::size_t cell = 0; cell < std::min(drawn.size(), primitive.ends.size()); ++cell) {
    if (drawn[cell] == 0) continue;
    const std::size_t first = cell == 0 ? 0 : primitive.ends[cell - 1];
    indices.insert(indices.end(), primitive.indices.begin() + static_cast<std::ptrdiff_t>(first),
                   primitive.indices.begin() + static_cast<std::ptrdiff_t>(primitive.ends[cell]));
  }
  return indices;
}

/// Cuts the chain of one node.
class ChainCut {
 public:
  ChainCut(tinygltf::Model& model, int node, const CutOptions& options) : model_(model), options_(options) {
    nodes_ = asset::lodNodes(model, node);
    nodes_.insert(nodes_.begin(), node);
  }

  CutNode run(const glm::dmat4& world) {
    CutNode result;
    result.name = meshOf(model_, nodes_[0]).name;
    std::vector<asset::LodCellLevels> tables;
    for (const int node : nodes_)
      tables.push_back(asset::lodCellLevels(model_, meshOf(model_, node)));
    const tinygltf::Node& finest = model_.nodes[static_cast<std::size_t>(nodes_[0])];
    if (tables[0].empty()) result.leftBecause = "its cells have no levels of their own; bake it with --cell-levels";
    if (finest.extensions.contains(kInstances)) result.leftBecause = "it has instances";
    std::optional<ObjectView> view = ObjectView();
    if (options_.eye) view = viewOf(world, options_);
    if (!view) result.leftBecause = "its transform cannot be inverted";
    if (!result.leftBecause.empty()) return result;
    const asset::CellHierarchy hierarchy(std::move(tables));
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      levels_.push_back(readLevel(model_, nodes_[k], hierarchy.cells(k), options_));
    chooseWhole(*view, result);
    write(hierarchy, choose(hierarchy, *view), result);
    return result;
  }

 private:
  double lengthLimit() const {
    return 0.01 * options_.errorPercent * asset::lodInfo(meshOf(model_, nodes_[0]))->measures->diagonal;
  }

  asset::CellCut choose(const asset::CellHierarchy& hierarchy, const ObjectView& view) const {
    if (!options_.eye) return asset::cutForError(hierarchy, lengthLimit(), options_.by);
    std::vector<std::vector<Aabb>> boxes;
    for (const LevelToCut& level : levels_)
      boxes.push_back(level.boxes);
    return asset::cutForEye(hierarchy, asset::groupBoxes(hierarchy, boxes), view.eye, view.slope, options_.by);
  }

  /// The coarsest whole level by its own error.
  void chooseWhole(const ObjectView& view, CutNode& result) const {
    Aabb box;
    for (const Aabb& cell : levels_[0].boxes)
      box.add(cell);
    const double limit = options_.eye ? view.slope * asset::distanceToBox(view.eye, box) : lengthLimit();
    while (result.wholeLevel + 1 < levels_.size() && levels_[result.wholeLevel + 1].error <= limit)
      ++result.wholeLevel;
    result.wholeTriangles = levels_[result.wholeLevel].triangles;
    result.finestTriangles = levels_[0].triangles;
  }

  void write(const asset::CellHierarchy& hierarchy, const asset::CellCut& cut, CutNode& result) {
    tinygltf::Mesh mesh;
    mesh.name = result.name;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      std::vector<std::uint8_t> drawn;
      for (std::uint32_t cell = 0; cell < hierarchy.cells(k); ++cell)
        drawn.push_back(hierarchy.isDrawn(cut, k, cell) ? 1 : 0);
      result.cells.push_back(static_cast<std::uint32_t>(std::count(drawn.begin(), drawn.end(), 1)));
      for (const PrimitiveCells& primitive : levels_[k].primitives) {
        if (k == 0 && asset::triangleCount(model_, *primitive.source) == 0)
          mesh.primitives.push_back(*primitive.source);
        const std::vector<std::uint32_t> indices = drawnIndices(primitive, drawn);
        if (indices.empty()) continue;
        mesh.primitives.push_back(*primitive.source);
        mesh.primitives.back().indices = asset::appendIndices(model_, indices);
        result.triangles += indices.size() / 3;
      }
    }
    replace(std::move(mesh));
  }

  /// The node shows the mesh of the cut; the nodes of the levels hold nothing.
  void replace(tinygltf::Mesh mesh) {
    tinygltf::Node& finest = model_.nodes[static_cast<std::size_t>(nodes_[0])];
    finest.mesh = static_cast<int>(model_.meshes.size());
    finest.extensions.erase(kChain);
    if (finest.extras.IsObject() && finest.extras.Has("MSFT_screencoverage")) {
      tinygltf::Value::Object extras = finest.extras.Get<tinygltf::Value::Object>();
      extras.erase("MSFT_screencoverage");
      finest.extras = extras.empty() ? tinygltf::Value() : tinygltf::Value(std::move(extras));
    }
    for (std::size_t k = 1; k < nodes_.size(); ++k)
      model_.nodes[static_cast<std::size_t>(nodes_[k])].mesh = -1;
    model_.meshes.push_back(std::move(mesh));
  }

  tinygltf::Model& model_;
  const CutOptions& options_;
  std::vector<int> nodes_;  ///< LOD 0 first
  std::vector<LevelToCut> levels_;
};

}  // namespace

std::vector<CutNode> cutDocument(tinygltf::Model& model, const CutOptions& options) {
  const std::vector<glm::dmat4> worlds = worldTransforms(model);
  std::vector<CutNode> nodes;
  for (std::size_t n = 0; n < worlds.size(); ++n) {
    if (asset::lodNodes(model, static_cast<int>(n)).empty()) continue;
    nodes.push_back(ChainCut(model, static_cast<int>(n), options).run(worlds[n]));
  }
  return nodes;
}

std::string cutText(const std::vector<CutNode>& nodes) {
  std::string text;
  for (const CutNode& node : nodes) {
    if (!node.leftBecause.empty()) {
      text += fmt::format("{}: its chain stays, {}\n", oneLine(node.name), node.leftBecause);
      continue;
    }
    text += fmt::format("{}: {} of {} triangles; a whole level within the limit: LOD {} with {}\n", oneLine(node.name),
                        node.triangles, node.finestTriangles, node.wholeLevel, node.wholeTriangles);
    for (std::size_t k = 0; k < node.cells.size(); ++k)
      if (node.cells[k] > 0) text += fmt::format("  LOD {}: {} cells\n", k, node.cells[k]);
  }
  return text.empty() ? "no node has a chain\n" : text;
}

std::string cutJson(const std::vector<CutNode>& nodes) {
  using nlohmann::ordered_json;
  ordered_json json;
  json["nodes"] = ordered_json::array();
  for (const CutNode& node : nodes) {
    if (!node.leftBecause.empty()) {
      json["nodes"].push_back({{"name", node.name}, {"left", node.leftBecause}});
      continue;
    }
    json["nodes"].push_back({{"name", node.name},
                             {"triangles", node.triangles},
                             {"triangles_whole", node.wholeTriangles},
                             {"lod_whole", node.wholeLevel},
                             {"triangles_finest", node.finestTriangles},
                             {"cells", node.cells}});
  }
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace jalousie::bake
