// One common grid per chain of levels; accessors rewritten one by one, shared ones once.
#include "asset/gltf_quantize.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "asset/accessor.h"
#include "asset/lod_cell_levels.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "asset/mesh_occluders.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kQuantization = "KHR_mesh_quantization";
constexpr std::uint64_t kNoLimit = ~0ULL;

bool canQuantize(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const tinygltf::Primitive& primitive) {
    return (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) && primitive.targets.empty() &&
           primitive.attributes.contains("POSITION") && !primitive.attributes.contains("JOINTS_0") &&
           primitive.extensions.empty() &&
           std::all_of(primitive.attributes.begin(), primitive.attributes.end(), [&](const auto& attribute) {
             const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(attribute.second)];
             const bool isCustom = attribute.first.starts_with("_");  // stays as it is
             return (isCustom || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) && accessor.count > 0;
           });
  });
}

/// Appends integers as an accessor; each element is padded to a multiple of four bytes.
template <class Integer>
int appendIntegers(tinygltf::Model& model, const std::vector<Integer>& values, std::size_t components, int type,
                   int componentType) {
  const std::size_t count = values.size() / components;
  const std::size_t stride = (components * sizeof(Integer) + 3) / 4 * 4;
  std::vector<std::byte> padded(stride * count);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&padded[i * stride], &values[i * components], components * sizeof(Integer));
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, padded, TINYGLTF_TARGET_ARRAY_BUFFER, stride);
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.normalized = true;
  accessor.count = count;
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

template <class Integer>
Integer rounded(double unit) {
  constexpr double kMost = std::numeric_limits<Integer>::max();
  const double low = std::numeric_limits<Integer>::is_signed ? -kMost : 0.0;
  return static_cast<Integer>(std::lround(std::clamp(unit * kMost, low, kMost)));
}

/// Cube that positions are counted from: offset + side * [0, 1]^3.
struct Grid {
  glm::dvec3 offset{0.0};
  double side = 1.0;
};

int quantizePositions(tinygltf::Model& model, int source, const Grid& grid) {
  const std::vector<glm::vec3> positions = readVec3(model, source, kNoLimit);
  std::vector<std::uint16_t> values;
  values.reserve(positions.size() * 3);
  std::array<std::uint16_t, 3> low = {65535, 65535, 65535};
  std::array<std::uint16_t, 3> high = {0, 0, 0};
  for (const glm::vec3& p : positions) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      values.push_back(rounded<std::uint16_t>((double{p[axis]} - grid.offset[axis]) / grid.side));
      low[k] = std::min(low[k], values.back());
      high[k] = std::max(high[k], values.back());
    }
  }
  const int index = appendIntegers(model, values, 3, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  accessor.minValues.assign(low.begin(), low.end());
  accessor.maxValues.assign(high.begin(), high.end());
  return index;
}

template <class Integer, class Vector>
int quantizeVectors(tinygltf::Model& model, const std::vector<Vector>& source, int type, int componentType) {
  std::vector<Integer> values;
  values.reserve(source.size() * static_cast<std::size_t>(Vector::length()));
  for (const Vector& vector : source)
    for (int k = 0; k < Vector::length(); ++k)
      values.push_back(rounded<Integer>(vector[k]));
  return appendIntegers(model, values, static_cast<std::size_t>(Vector::length()), type, componentType);
}

template <class Vector>
bool isInUnitRange(const std::vector<Vector>& values) {
  return std::all_of(values.begin(), values.end(), [](const Vector& value) {
    for (int k = 0; k < Vector::length(); ++k)
      if (!(value[k] >= 0.0F && value[k] <= 1.0F)) return false;
    return true;
  });
}

/// The accessor of smaller numbers, or the same one where there is none.
int quantizeAttribute(tinygltf::Model& model, const std::string& name, int source) {
  const int type = model.accessors[static_cast<std::size_t>(source)].type;
  if (name == "NORMAL" && type == TINYGLTF_TYPE_VEC3)
    return quantizeVectors<std::int8_t>(model, readVec3(model, source, kNoLimit), type, TINYGLTF_COMPONENT_TYPE_BYTE);
  if (name == "TANGENT" && type == TINYGLTF_TYPE_VEC4)
    return quantizeVectors<std::int8_t>(model, readVec4(model, source, kNoLimit), type, TINYGLTF_COMPONENT_TYPE_BYTE);
  if (name.starts_with("TEXCOORD_") && type == TINYGLTF_TYPE_VEC2) {
    const std::vector<glm::vec2> values = readVec2(model, source, kNoLimit);
    if (isInUnitRange(values))
      return quantizeVectors<std::uint16_t>(model, values, type, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  }
  if (name.starts_with("COLOR_")) {
    const std::vector<glm::vec4> values = readVec4(model, source, kNoLimit);
    if (isInUnitRange(values))
      return quantizeVectors<std::uint8_t>(model, values, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  }
  return source;
}

/// Nodes that show one chain of meshes together: LOD 0 nodes and, per node, those of its levels.
struct QuantizedChain {
  std::vector<int> nodes;
  std::set<int> meshes;
  bool movable = true;  ///< positions may go onto a grid
};

/// Groups of meshes that must share a grid.
std::vector<QuantizedChain> findChains(const tinygltf::Model& model) {
  std::vector<bool> isLower(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    for (const int lower : lodNodes(model, static_cast<int>(n)))
      isLower[static_cast<std::size_t>(lower)] = true;
  std::vector<QuantizedChain> chains;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (isLower[n] || node.mesh < 0) continue;
    QuantizedChain chain;
    chain.nodes = {static_cast<int>(n)};
    chain.meshes = {node.mesh};
    chain.movable = node.skin < 0 && !node.extensions.contains("EXT_mesh_gpu_instancing");
    for (const int lower : lodNodes(model, static_cast<int>(n)))
      chain.meshes.insert(model.nodes[static_cast<std::size_t>(lower)].mesh);
    // Merge with chains that share a mesh.
    for (QuantizedChain& other : chains) {
      const bool shares =
          std::any_of(chain.meshes.begin(), chain.meshes.end(), [&](int mesh) { return other.meshes.contains(mesh); });
      if (!shares) continue;
      chain.nodes.insert(chain.nodes.begin(), other.nodes.begin(), other.nodes.end());
      chain.meshes.merge(other.meshes);
      chain.movable = chain.movable && other.movable;
      other.nodes.clear();
      other.meshes.clear();
    }
    std::erase_if(chains, [](const QuantizedChain& other) { return other.nodes.empty(); });
    chains.push_back(std::move(chain));
  }
  return chains;
}

/// A power of two scales normals, errors and positions without rounding.
double gridSide(double extent) {
  return extent > 0.0 ? std::exp2(std::ceil(std::log2(extent))) : 1.0;
}

/// By how much positions and errors may be off: half a step of each of two surfaces, of a grid with this side.
double roundingOf(double side) {
  return side * std::sqrt(3.0) / 65535.0;
}

/// The grid of some meshes. Errors: kUnsupported (its side is no finite float).
Grid gridOf(const tinygltf::Model& model, const std::set<int>& meshes) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const int mesh : meshes) {
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
      for (const glm::vec3& p : readVec3(model, primitive.attributes.at("POSITION"), kNoLimit)) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
      }
    }
  }
  const glm::dvec3 extent = high - low;
  const double side = std::max({extent.x, extent.y, extent.z});
  const double grid = gridSide(side);
  if (!std::isfinite(static_cast<float>(grid)))
    throw Error(ErrorCode::kUnsupported,
                fmt::format("mesh {}: its positions span {:g} units, too many for a grid; leave out --quantize",
                            *meshes.begin(), side));
  return {low, grid};
}

/// Lengths of extras.jalousie in the mesh's new object space, with the rounding added to what may be off. The order of
/// the triangles stays, and with it the cells.
void rescaleInfo(const tinygltf::Model& model, tinygltf::Mesh& mesh, const Grid& grid) {
  setOccluders(mesh, {});  // rounded positions may leave them outside; the baker makes new ones
  std::optional<LodInfo> info = lodInfo(mesh);
  if (!info) return;
  const double rounding = info->lod > 0 ? roundingOf(1.0) : 0.0;
  info->errorObject = info->errorObject / grid.side + rounding;
  if (info->measures) {
    LodMeasures& measures = *info->measures;
    measures.diagonal /= grid.side;
    if (measures.target) *measures.target /= grid.side;
    for (DistanceInfo* distance : {&measures.toOriginal, &measures.fromOriginal, &measures.twoSided}) {
      distance->max = distance->max / grid.side + rounding;
      distance->mean /= grid.side;
    }
  }
  const CellTriangles cells = lodCells(model, mesh);
  LodCellLevels cellLevels = lodCellLevels(model, mesh);
  for (DistanceInfo& error : cellLevels.errors)
    error = {error.max / grid.side + roundingOf(1.0), error.mean / grid.side};
  const LodFaces faces = lodFaces(model, mesh);
  setLodInfo(mesh, *info);
  if (!cells.empty()) setLodCells(mesh, cells);
  setLodCellLevels(mesh, cellLevels);
  setLodFaces(mesh, faces);
}

/// A child of the node that carries the mesh back to object space.
void moveMeshIntoChild(tinygltf::Model& model, int index, const Grid& grid) {
  std::vector<int> lower = lodNodes(model, index);
  const int empty = emptyLevel(model, index);
  if (empty >= 0) lower.push_back(empty);
  const std::vector<float> coverage = lodCoverage(model.nodes[static_cast<std::size_t>(index)]);
  const auto place = [&](tinygltf::Node& node) {
    node.matrix.clear();
    node.rotation.clear();
    node.translation = {grid.offset.x, grid.offset.y, grid.offset.z};
    node.scale = {grid.side, grid.side, grid.side};
  };
  tinygltf::Node child;
  child.name = model.nodes[static_cast<std::size_t>(index)].name;
  child.mesh = model.nodes[static_cast<std::size_t>(index)].mesh;
  place(child);
  const auto childIndex = static_cast<int>(model.nodes.size());
  model.nodes.push_back(std::move(child));
  tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
  node.mesh = -1;
  node.children.push_back(childIndex);
  if (lower.empty()) return;
  node.extensions.erase("MSFT_lod");
  if (node.extras.IsObject()) {
    auto extras = node.extras.Get<tinygltf::Value::Object>();
    extras.erase("MSFT_screencoverage");
    node.extras = extras.empty() ? tinygltf::Value() : tinygltf::Value(std::move(extras));
  }
  for (const int n : lower)
    place(model.nodes[static_cast<std::size_t>(n)]);
  // The parent moves them now; a channel of their own would take the grid's transform away.
  for (tinygltf::Animation& animation : model.animations) {
    std::erase_if(animation.channels, [&](const tinygltf::AnimationChannel& channel) {
      return std::find(lower.begin(), lower.end(), channel.target_node) != lower.end();
    });
  }
  std::erase_if(model.animations, [](const tinygltf::Animation& animation) { return animation.channels.empty(); });
  std::vector<float> levels = coverage;
  if (!levels.empty()) levels.resize(lower.size() + 1, 0.0F);
  setLodChain(model, childIndex, lower, levels);
}

void declare(std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), kQuantization) == names.end()) names.emplace_back(kQuantization);
}

}  // namespace

double quantizeRounding(double extent) {
  return roundingOf(gridSide(extent));
}

void quantizeModel(tinygltf::Model& model) {
  bool changed = false;
  for (const QuantizedChain& chain : findChains(model)) {
    const bool all = std::all_of(chain.meshes.begin(), chain.meshes.end(), [&](int mesh) {
      return canQuantize(model, model.meshes[static_cast<std::size_t>(mesh)]);
    });
    if (!all) continue;
    const Grid grid = gridOf(model, chain.meshes);
    std::map<int, int> done;  // accessors may be shared
    for (const int index : chain.meshes) {
      tinygltf::Mesh mesh = model.meshes[static_cast<std::size_t>(index)];
      for (tinygltf::Primitive& primitive : mesh.primitives) {
        for (auto& [name, accessor] : primitive.attributes) {
          if (name == "POSITION" && !chain.movable) continue;
          const auto [found, isNew] = done.try_emplace(accessor, accessor);
          if (isNew)
            found->second = name == "POSITION" ? quantizePositions(model, accessor, grid)
                                               : quantizeAttribute(model, name, accessor);
          accessor = found->second;
        }
      }
      if (chain.movable) rescaleInfo(model, mesh, grid);
      model.meshes[static_cast<std::size_t>(index)] = std::move(mesh);
      changed = true;
    }
    if (!chain.movable) continue;
    for (const int node : chain.nodes)
      moveMeshIntoChild(model, node, grid);
  }
  if (!changed) return;
  declare(model.extensionsUsed);
  declare(model.extensionsRequired);
}

}  // namespace jalousie::asset
