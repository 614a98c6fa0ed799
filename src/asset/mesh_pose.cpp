// Linear blend skinning and morph targets on the CPU.
#include "asset/mesh_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// The blended matrix of each vertex.
std::vector<glm::dmat4> blendedMatrices(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                        const MeshPose& pose, ElementBudget& budget, std::size_t count) {
  std::vector<glm::dmat4> blended(count, glm::dmat4(0.0));
  for (int set = 0;; ++set) {
    const std::string number = std::to_string(set);
    const std::vector<glm::vec4> joints = attribute(model, primitive.attributes, "JOINTS_" + number, count, readVec4);
    const std::vector<glm::vec4> weights = attribute(model, primitive.attributes, "WEIGHTS_" + number, count, readVec4);
    if (joints.empty() || weights.empty()) break;
    budget.take(2 * count);
    for (std::size_t v = 0; v < count; ++v)
      for (int k = 0; k < 4; ++k) {
        if (!(weights[v][k] > 0.0F)) continue;  // joints of unused weights may be anything
        const float joint = joints[v][k];
        if (!(joint >= 0.0F) || !(joint < static_cast<float>(pose.worldFromMesh.size())))
          malformed("a vertex names a joint that its skin does not have");
        blended[v] += static_cast<double>(weights[v][k]) * pose.worldFromMesh[static_cast<std::size_t>(joint)];
      }
  }
  return blended;
}

void bend(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshPose& pose,
          ElementBudget& budget, const PosedVertices& vertices) {
  if (!primitive.attributes.contains("JOINTS_0") || !primitive.attributes.contains("WEIGHTS_0")) return;
  const std::vector<glm::dmat4> blended = blendedMatrices(model, primitive, pose, budget, vertices.positions.size());
  for (std::size_t v = 0; v < blended.size(); ++v) {
    vertices.positions[v] = glm::vec3(blended[v] * glm::dvec4(vertices.positions[v], 1.0));
    if (vertices.normals.empty()) continue;
    const glm::dmat3 linear(blended[v]);
    // The cofactors are the inverse transpose up to a factor, and exist for flattened vertices, too.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    vertices.normals[v] = glm::vec3(cofactors * glm::dvec3(vertices.normals[v]));
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

void applyPose(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshPose& pose,
               ElementBudget& budget, const PosedVertices& vertices) {
  morph(model, primitive, pose.weights, budget, vertices);
  if (!pose.worldFromMesh.empty()) bend(model, primitive, pose, budget, vertices);
}

}  // namespace jalousie::asset::detail
