// Linear blend skinning and morph targets on the CPU.
#include "asset/mesh_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "asset/accessor.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

[[noreturn]] void malformed(const char* what) {
  throw Error(ErrorCode::kMalformed, what);
}

/// An attribute with one element for each vertex; empty if the primitive has none.
template <class Read>
auto attribute(const tinygltf::Model& model, const std::map<std::string, int>& attributes, const std::string& name,
               std::size_t vertices, const Read& read) -> decltype(read(model, 0, 0)) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return {};
  auto values = read(model, found->second, vertices);
  if (values.size() != vertices) malformed("attributes differ in length");
  return values;
}

bool finite(const gpu::MorphDelta& delta) {
  for (glm::length_t k = 0; k < 3; ++k)
    if (!std::isfinite(delta.position[k]) || !std::isfinite(delta.normal[k])) return false;
  return true;
}

void addScaled(const std::vector<glm::vec3>& offsets, double weight, std::vector<glm::vec3>& values) {
  for (std::size_t v = 0; v < offsets.size(); ++v)
    values[v] += static_cast<float>(weight) * offsets[v];
}

void morph(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
           ElementBudget& budget, const PosedVertices& vertices) {
  for (std::size_t target = 0; target < std::min(primitive.targets.size(), weights.size()); ++target) {
    if (weights[target] == 0.0) continue;
    budget.take(2 * vertices.positions.size());
    const std::map<std::string, int>& attributes = primitive.targets[target];
    const std::size_t count = vertices.positions.size();
    addScaled(attribute(model, attributes, "POSITION", count, readVec3), weights[target], vertices.positions);
    if (!vertices.normals.empty())
      addScaled(attribute(model, attributes, "NORMAL", count, readVec3), weights[target], vertices.normals);
  }
}

/// The joints that place each vertex.
struct Influences {
  std::vector<std::uint32_t> first;  ///< [vertices + 1] into entries
  std::vector<gpu::Influence> entries;
};

/// Makes the sum 1, which glTF asks for. Else the place of a vertex would depend on that of the whole scene.
void normalizeWeights(std::span<gpu::Influence> influences) {
  double sum = 0.0;
  for (const gpu::Influence& influence : influences)
    sum += static_cast<double>(influence.weight);
  for (gpu::Influence& influence : influences)
    influence.weight = static_cast<float>(static_cast<double>(influence.weight) / sum);
}

/// @param joints  of the skin
Influences readInfluences(const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t joints,
                          ElementBudget& budget, std::size_t count) {
  struct Set {
    std::vector<glm::vec4> joints;
    std::vector<glm::vec4> weights;
  };
  std::vector<Set> sets;
  for (;;) {
    const std::string number = std::to_string(sets.size());
    Set set{attribute(model, primitive.attributes, "JOINTS_" + number, count, readVec4),
            attribute(model, primitive.attributes, "WEIGHTS_" + number, count, readVec4)};
    if (set.joints.empty() || set.weights.empty()) break;
    budget.take(2 * count);
    sets.push_back(std::move(set));
  }
  Influences result;
  result.first.reserve(count + 1);
  for (std::size_t v = 0; v < count; ++v) {
    const std::size_t first = result.entries.size();
    result.first.push_back(static_cast<std::uint32_t>(first));
    for (const Set& set : sets) {
      for (int k = 0; k < 4; ++k) {
        const float weight = set.weights[v][k];
        if (!(weight > 0.0F)) continue;  // joints of unused weights may be anything
        const float joint = set.joints[v][k];
        if (!(joint >= 0.0F) || !(joint < static_cast<float>(joints)))
          malformed("a vertex names a joint that its skin does not have");
        result.entries.push_back({static_cast<std::uint32_t>(joint), weight});
      }
    }
    normalizeWeights(std::span(result.entries).subspan(first));
    if (result.entries.size() > 0xFFFFFFFFULL) throw Error(ErrorCode::kLimit, "a skin has too many weights");
  }
  result.first.push_back(static_cast<std::uint32_t>(result.entries.size()));
  return result;
}

bool isSkinned(const tinygltf::Primitive& primitive) {
  return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
}

void bend(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshPose& pose,
          ElementBudget& budget, const PosedVertices& vertices) {
  if (!isSkinned(primitive)) return;
  const std::size_t count = vertices.positions.size();
  const Influences influences = readInfluences(model, primitive, pose.worldFromMesh.size(), budget, count);
  for (std::size_t v = 0; v < count; ++v) {
    glm::dmat4 blended(0.0);
    for (std::uint32_t i = influences.first[v]; i < influences.first[v + 1]; ++i)
      blended += static_cast<double>(influences.entries[i].weight) * pose.worldFromMesh[influences.entries[i].joint];
    vertices.positions[v] = glm::vec3(blended * glm::dvec4(vertices.positions[v], 1.0));
    if (vertices.normals.empty()) continue;
    const glm::dmat3 linear(blended);
    // The cofactors are the inverse transpose up to a factor, and exist for flattened vertices, too.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double handedness = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    vertices.normals[v] = glm::vec3(handedness * (cofactors * glm::dvec3(vertices.normals[v])));
  }
}

}  // namespace

bool MeshPose::isRest() const {
  return worldFromMesh.empty() && std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0.0; });
}

double MeshPose::largestScale() const {
  double largest = worldFromMesh.empty() ? 1.0 : 0.0;
  for (const glm::dmat4& matrix : worldFromMesh) {
    // The norm of a matrix is at most the root of the largest row sum of its product with its transpose.
    const glm::dmat3 linear(matrix);
    const glm::dmat3 product = glm::transpose(linear) * linear;
    for (int row = 0; row < 3; ++row)
      largest = std::max(largest,
                         std::sqrt(std::abs(product[0][row]) + std::abs(product[1][row]) + std::abs(product[2][row])));
  }
  return largest;
}

ShownMesh shownMesh(const tinygltf::Model& model, int node) {
  const tinygltf::Node& source = model.nodes[static_cast<std::size_t>(node)];
  const std::vector<tinygltf::Primitive>& primitives = model.meshes[static_cast<std::size_t>(source.mesh)].primitives;
  const bool isPosed = source.skin >= 0 || std::any_of(primitives.begin(), primitives.end(),
                                                       [](const tinygltf::Primitive& p) { return !p.targets.empty(); });
  return {source.mesh, isPosed ? node : -1};
}

PrimitiveBending readBending(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                             const BendingTables& tables, ElementBudget& budget, const PosedVertices& vertices) {
  const std::size_t count = vertices.positions.size();
  PrimitiveBending bending;
  bending.positions = vertices.positions;
  bending.normals = vertices.normals;
  budget.take(2 * count);
  for (const std::map<std::string, int>& attributes : primitive.targets) {
    budget.take(2 * count);
    const std::vector<glm::vec3> positions = attribute(model, attributes, "POSITION", count, readVec3);
    std::vector<glm::vec3> normals;
    if (!vertices.normals.empty()) normals = attribute(model, attributes, "NORMAL", count, readVec3);
    for (std::size_t v = 0; v < count; ++v) {
      bending.deltas.push_back({glm::vec4(positions.empty() ? glm::vec3(0.0F) : positions[v], 0.0F),
                                glm::vec4(normals.empty() ? glm::vec3(0.0F) : normals[v], 0.0F)});
      if (!finite(bending.deltas.back())) malformed("a morph target is not finite");
    }
    ++bending.targets;
  }
  bending.isSkinned = tables.joints > 0 && isSkinned(primitive);
  if (!bending.isSkinned) return bending;
  Influences influences = readInfluences(model, primitive, tables.joints, budget, count);
  for (gpu::Influence& influence : influences.entries) {
    if (!std::isfinite(influence.weight)) malformed("a weight of a joint is not finite");
    influence.joint += tables.firstJoint;
  }
  bending.firstInfluence = std::move(influences.first);
  bending.influences = std::move(influences.entries);
  return bending;
}

PrimitiveBending flatBending(const PrimitiveBending& shared, const std::vector<std::uint32_t>& indices,
                             ElementBudget& budget) {
  budget.take((1 + shared.targets) * indices.size());
  PrimitiveBending flat;
  flat.isSkinned = shared.isSkinned;
  flat.targets = shared.targets;
  for (const std::uint32_t v : indices)
    flat.positions.push_back(shared.positions[v]);
  for (std::uint32_t target = 0; target < shared.targets; ++target)
    for (const std::uint32_t v : indices)
      flat.deltas.push_back(shared.deltas[target * shared.positions.size() + v]);
  if (!shared.isSkinned) return flat;
  flat.firstInfluence.push_back(0);
  for (const std::uint32_t v : indices) {
    const std::uint32_t first = shared.firstInfluence[v];
    const std::uint32_t end = shared.firstInfluence[v + 1];
    budget.take(end - first);
    flat.influences.insert(flat.influences.end(), shared.influences.begin() + first, shared.influences.begin() + end);
    flat.firstInfluence.push_back(static_cast<std::uint32_t>(flat.influences.size()));
  }
  return flat;
}

void applyPose(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshPose& pose,
               ElementBudget& budget, const PosedVertices& vertices) {
  morph(model, primitive, pose.weights, budget, vertices);
  if (!pose.worldFromMesh.empty()) bend(model, primitive, pose, budget, vertices);
}

}  // namespace jalousie::asset::detail
