// Walks over the nodes of the default scene: transforms, chains and measures of their meshes, and what is left out.
#include "scatter/source_asset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "asset/triangle_count.h"
#include "core/error.h"

namespace jalousie::scatter {
namespace {

using tinygltf::Model;

struct Visit {
  int node;
  glm::dmat4 worldFromNode;
};

const tinygltf::Node& nodeOf(const Model& model, int node) {
  return model.nodes[static_cast<std::size_t>(node)];
}

/// Visits the nodes of the default scene, depth first, parents before their children.
template <class OnNode>
void walk(const Model& model, const OnNode& onNode) {
  std::vector<Visit> stack;
  const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& worldFromParent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
      stack.push_back({*node, worldFromParent * asset::localTransform(nodeOf(model, *node))});
  };
  push(asset::sceneRoots(model), glm::dmat4(1.0));
  while (!stack.empty()) {
    const Visit top = stack.back();
    stack.pop_back();
    onNode(top);
    push(nodeOf(model, top.node).children, top.worldFromNode);
  }
}

/// Triangles of each mesh.
std::vector<std::uint64_t> trianglesOf(const Model& model) {
  std::vector<std::uint64_t> triangles(model.meshes.size(), 0);
  for (std::size_t m = 0; m < triangles.size(); ++m)
    for (const tinygltf::Primitive& primitive : model.meshes[m].primitives)
      triangles[m] += asset::triangleCount(model, primitive);
  return triangles;
}

bool isScattered(const tinygltf::Node& node, const std::vector<std::uint64_t>& triangles) {
  return node.mesh >= 0 && triangles[static_cast<std::size_t>(node.mesh)] > 0;
}

/// Splits a matrix into translation, rotation and scale, the only transforms that instances have.
Pose decompose(const glm::dmat4& matrix, int node) {
  glm::dmat3 linear(matrix);
  glm::dvec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
  if (glm::determinant(linear) < 0.0) scale.x = -scale.x;
  const double size = std::max({std::abs(scale.x), scale.y, scale.z});
  if (!std::isfinite(size) || std::min({std::abs(scale.x), scale.y, scale.z}) <= 1e-12 * size)
    throw Error(ErrorCode::kUnsupported, fmt::format("node {} has a transform without an inverse", node));
  for (int axis = 0; axis < 3; ++axis)
    linear[axis] /= scale[axis];
  constexpr double kTolerance = 1e-5;
  const double shear = std::max({std::abs(glm::dot(linear[0], linear[1])), std::abs(glm::dot(linear[1], linear[2])),
                                 std::abs(glm::dot(linear[0], linear[2]))});
  if (shear > kTolerance) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("node {} has a transform with shear, which instances cannot have; apply the transforms of "
                            "the nodes above it to its mesh",
                            node));
  }
  return {glm::vec3(matrix[3]), glm::quat(glm::quat_cast(linear)), glm::vec3(scale)};
}

std::vector<Pose> posesOf(const Model& model, const Visit& visit) {
  const asset::InstanceTransforms instances = asset::readInstances(model, visit.node);
  if (instances.count == 0) return {decompose(visit.worldFromNode, visit.node)};
  std::vector<Pose> poses;
  poses.reserve(instances.count);
  for (std::uint64_t i = 0; i < instances.count; ++i)
    poses.push_back(decompose(visit.worldFromNode * instances.nodeFromInstance(i), visit.node));
  return poses;
}

std::vector<glm::vec3> positionsOf(const Model& model, int mesh) {
  std::vector<glm::vec3> positions;
  for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) continue;
    const std::vector<glm::vec3> more = asset::readVec3(model, position->second, asset::Limits{}.maxAccessorElements);
    positions.insert(positions.end(), more.begin(), more.end());
  }
  return positions;
}

Aabb boxOf(const Model& model, int mesh) {
  Aabb box;
  for (const glm::vec3& p : positionsOf(model, mesh))
    box.add(p);
  return box;
}

/// The points that lie farthest in the directions of a lattice around the origin, each once, in their order.
std::vector<glm::vec3> outermostOf(const std::vector<glm::vec3>& points) {
  constexpr int kReach = 3;
  std::vector<std::size_t> found;
  for (int x = -kReach; x <= kReach; ++x) {
    for (int y = -kReach; y <= kReach; ++y) {
      for (int z = -kReach; z <= kReach; ++z) {
        const glm::vec3 direction(x, y, z);
        const auto nearer = [&](const glm::vec3& a, const glm::vec3& b) {
          return glm::dot(a, direction) < glm::dot(b, direction);
        };
        const auto farthest = std::max_element(points.begin(), points.end(), nearer);
        if (farthest != points.end()) found.push_back(static_cast<std::size_t>(farthest - points.begin()));
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<glm::vec3> outermost;
  outermost.reserve(found.size());
  for (const std::size_t i : found)
    outermost.push_back(points[i]);
  return outermost;
}

/// The part of a node but for its triangles and its box.
SourcePart partOf(const Model& model, const Visit& visit) {
  const tinygltf::Node& node = nodeOf(model, visit.node);
  SourcePart part;
  part.name = node.name.empty() ? model.meshes[static_cast<std::size_t>(node.mesh)].name : node.name;
  part.meshes = {node.mesh};
  for (const int lower : asset::lodNodes(model, visit.node))
    part.meshes.push_back(nodeOf(model, lower).mesh);
  part.coverage = asset::lodCoverage(node);
  part.endsInNothing = asset::emptyLevel(model, visit.node) >= 0;
  part.weights = node.weights;
  part.poses = posesOf(model, visit);
  return part;
}

/// What is left out of a node.
void countIgnored(const Model& model, int index, asset::ContentCounts& ignored) {
  const tinygltf::Node& node = nodeOf(model, index);
  const auto countIf = [&](bool condition, const char* what) {
    if (condition) ++ignored[what];
  };
  countIf(node.camera >= 0, "cameras");
  countIf(node.skin >= 0, "skins");
  countIf(node.extensions.contains(kLights), "lights");
  countIf(asset::isLodGroup(model, index), "groups with levels, of which LOD 0 is scattered");
}

/// Box of all parts, world space of the input.
Aabb boxOf(const std::vector<SourcePart>& parts) {
  Aabb box;
  for (const SourcePart& part : parts) {
    for (const Pose& pose : part.poses) {
      const glm::mat4 turned = glm::translate(glm::mat4(1.0F), pose.translation) * glm::mat4_cast(pose.rotation);
      box.add(transformed(glm::scale(turned, pose.scale), part.boxObject));
    }
  }
  return box;
}

}  // namespace

std::uint64_t SourceAsset::triangles() const {
  std::uint64_t sum = 0;
  for (const SourcePart& part : parts)
    sum += part.triangles * part.poses.size();
  return sum;
}

std::uint32_t SourceAsset::levels() const {
  std::size_t most = 0;
  for (const SourcePart& part : parts)
    most = std::max(most, part.meshes.size());
  return static_cast<std::uint32_t>(most);
}

std::uint64_t instancesPerObject(const Model& model) {
  const std::vector<std::uint64_t> triangles = trianglesOf(model);
  std::uint64_t instances = 0;
  walk(model, [&](const Visit& visit) {
    if (isScattered(nodeOf(model, visit.node), triangles))
      instances += std::max<std::uint64_t>(asset::countInstances(model, visit.node), 1);
  });
  return instances;
}

SourceAsset findSourceAsset(const Model& model) {
  const std::vector<std::uint64_t> triangles = trianglesOf(model);
  std::map<int, Aabb> boxes;  // by mesh
  SourceAsset source;
  walk(model, [&](const Visit& visit) {
    const int mesh = nodeOf(model, visit.node).mesh;
    countIgnored(model, visit.node, source.ignored);
    if (!isScattered(nodeOf(model, visit.node), triangles)) {
      if (mesh >= 0) ++source.ignored["meshes without triangles"];
      return;
    }
    if (!boxes.contains(mesh)) boxes[mesh] = boxOf(model, mesh);
    source.parts.push_back(partOf(model, visit));
    source.parts.back().triangles = triangles[static_cast<std::size_t>(mesh)];
    source.parts.back().boxObject = boxes[mesh];
  });
  for (const tinygltf::Animation& animation : model.animations)
    source.ignored["animation channels"] += animation.channels.size();
  std::erase_if(source.ignored, [](const auto& kind) { return kind.second == 0; });
  if (source.parts.empty()) throw Error(ErrorCode::kUnsupported, "the scene has no mesh with triangles to scatter");
  const Aabb box = boxOf(source.parts);
  source.center = box.center();
  const SourcePart& first = source.parts.front();
  source.diagonal = source.isSingle() ? glm::length(first.boxObject.extent() * glm::abs(first.poses[0].scale))
                                      : glm::length(box.extent());
  if (!std::isfinite(source.diagonal) || !(source.diagonal > 0.0F))
    throw Error(ErrorCode::kUnsupported, "the meshes to scatter have no size");
  return source;
}

void findOutermost(const Model& model, SourceAsset& source) {
  for (SourcePart& part : source.parts)
    part.outermost = outermostOf(positionsOf(model, part.meshes.front()));
}

}  // namespace jalousie::scatter
