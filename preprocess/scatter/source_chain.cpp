// Finds the scattered node, its transform and the measures of its chain.
#include "scatter/source_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "asset/triangle_count.h"
#include "core/error.h"

namespace jalousie::scatter {
namespace {

using tinygltf::Model;

struct Found {
  int node;
  glm::dmat4 worldFromNode;
};

std::optional<Found> firstMeshNode(const Model& model) {
  std::vector<Found> stack;
  const std::vector<int> roots = asset::sceneRoots(model);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root)
    stack.push_back({*root, glm::dmat4(1.0)});
  while (!stack.empty()) {
    const Found top = stack.back();
    stack.pop_back();
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(top.node)];
    const glm::dmat4 worldFromNode = top.worldFromNode * asset::localTransform(node);
    if (node.mesh >= 0) return Found{top.node, worldFromNode};
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      stack.push_back({*child, worldFromNode});
  }
  return std::nullopt;
}

/// Splits a matrix into translation, rotation and scale, the only transforms that instances have.
Pose decompose(const glm::dmat4& matrix) {
  glm::dmat3 linear(matrix);
  glm::dvec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
  if (glm::determinant(linear) < 0.0) scale.x = -scale.x;
  const double size = std::max({std::abs(scale.x), scale.y, scale.z});
  if (!std::isfinite(size) || std::min({std::abs(scale.x), scale.y, scale.z}) <= 1e-12 * size)
    throw Error(ErrorCode::kUnsupported, "the mesh's node has a transform without an inverse");
  for (int axis = 0; axis < 3; ++axis)
    linear[axis] /= scale[axis];
  constexpr double kTolerance = 1e-5;
  const double shear = std::max({std::abs(glm::dot(linear[0], linear[1])), std::abs(glm::dot(linear[1], linear[2])),
                                 std::abs(glm::dot(linear[0], linear[2]))});
  if (shear > kTolerance) throw Error(ErrorCode::kUnsupported, "the mesh's node has a transform with shear");
  return {glm::vec3(matrix[3]), glm::quat(glm::quat_cast(linear)), glm::vec3(scale)};
}

void measure(const Model& model, int mesh, bool finest, SourceChain& chain) {
  const std::uint64_t most = asset::Limits{}.maxAccessorElements;
  std::uint64_t triangles = 0;
  for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
    triangles += asset::triangleCount(model, primitive);
    const auto position = primitive.attributes.find("POSITION");
    if (!finest || position == primitive.attributes.end()) continue;
    for (const glm::vec3& p : asset::readVec3(model, position->second, most))
      chain.boxObject.add(p);
  }
  chain.meshes.push_back(mesh);
  chain.triangles.push_back(triangles);
}

}  // namespace

SourceChain findSourceChain(const Model& model) {
  const std::optional<Found> found = firstMeshNode(model);
  if (!found) throw Error(ErrorCode::kUnsupported, "the scene has no mesh to scatter");
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(found->node)];
  SourceChain chain;
  chain.worldFromObject = decompose(found->worldFromNode);
  chain.coverage = asset::lodCoverage(node);
  measure(model, node.mesh, true, chain);
  for (const int lower : asset::lodNodes(model, found->node))
    measure(model, model.nodes[static_cast<std::size_t>(lower)].mesh, false, chain);
  const float diagonal = chain.diagonal();
  if (chain.triangles[0] == 0 || !std::isfinite(diagonal) || !(diagonal > 0.0F))
    throw Error(ErrorCode::kUnsupported, "the mesh to scatter has no triangles or no size");
  return chain;
}

}  // namespace jalousie::scatter
