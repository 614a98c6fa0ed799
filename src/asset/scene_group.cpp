// Places the meshes of a level side by side; no primitives are merged, so that materials stay as they are.
#include "asset/scene_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "core/error.h"
#include "core/memory_estimate.h"
#include "core/normal_transform.h"

namespace jalousie::asset::detail {
namespace {

void place(Primitive& primitive, const glm::dmat4& transform) {
  const NormalTransform normalTransform{glm::dmat3(transform)};
  for (glm::vec3& position : primitive.positions) {
    position = glm::vec3(transform * glm::dvec4(position, 1.0));
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
      throw Error(ErrorCode::kMalformed, "a position in a level of a group is not finite");
  }
  for (glm::vec3& normal : primitive.normals)
    normal = normalTransform(normal);
  if (normalTransform.mirrors())
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
      std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
  primitive.cellEnds.clear();
  primitive.faceTree.clear();
}

std::uint64_t elementsOf(const Mesh& mesh) {
  std::uint64_t elements = 0;
  for (const Primitive& primitive : mesh.primitives)
    elements += primitive.positions.size() + primitive.indices.size();
  return elements;
}

/// Adds what a mesh stores of its deviation from its own LOD 0. @param scale  largest one of the mesh in the group
void addError(const tinygltf::Mesh& mesh, double scale, LevelMesh& level) {
  const std::optional<LodInfo> info = lodInfo(mesh);
  const float error = info ? static_cast<float>(scale * info->errorObject) : std::numeric_limits<float>::infinity();
  level.errorObject = std::max(level.errorObject, error);
  if (!level.meanErrorObject) return;
  if (!info || !info->measures) {
    level.meanErrorObject.reset();
  } else {
    level.meanErrorObject = std::max(*level.meanErrorObject, static_cast<float>(scale * info->measures->twoSided.mean));
  }
}

}  // namespace

Mesh placedMesh(Mesh mesh, const glm::dmat4& transform) {
  for (Primitive& primitive : mesh.primitives)
    place(primitive, transform);
  return mesh;
}

void GroupReader::addPart(const GroupPart& part, const glm::dmat4& groupFromMesh, const MeshContext& context,
                          LevelMesh& level) {
  const Mesh mesh = readMesh(model_, part.mesh.mesh, context);
  if (mesh.primitives.empty()) return;
  ++level.parts;
  const InstanceTransforms instances = readInstances(model_, part.node, limits_);
  const std::uint64_t copies = std::max<std::uint64_t>(instances.count, 1);
  context.budget.take(saturatingProduct(copies - 1, elementsOf(mesh)));
  double scale = 0.0;
  for (std::uint64_t i = 0; i < copies; ++i) {
    const glm::dmat4 placed = instances.count > 0 ? groupFromMesh * instances.nodeFromInstance(i) : groupFromMesh;
    if (!isFinite(placed))
      throw Error(ErrorCode::kMalformed, fmt::format("node {}: transform in its group is not finite", part.node));
    Mesh copy = placedMesh(mesh, placed);
    std::move(copy.primitives.begin(), copy.primitives.end(), std::back_inserter(level.mesh.primitives));
    scale = std::max(scale, MeshPose{{placed}, {}}.largestScale());
  }
  addError(model_.meshes[static_cast<std::size_t>(part.mesh.mesh)], scale * context.pose.largestScale(), level);
}

LevelMesh GroupReader::read(const GroupLevel& level, const GroupPlace& place, const std::vector<Material>& materials,
                            ElementBudget& budget) {
  const auto local = [this](int node) { return pose_.localTransform(node); };
  const glm::dmat4 groupFromLevelNode = groupFromLevel(local, place.group, level.node);
  LevelMesh result;
  result.mesh.name = model_.nodes[static_cast<std::size_t>(level.node)].name;
  for (const GroupPart& part : groups_.parts(level.content, local)) {
    const bool isSkinned = model_.nodes[static_cast<std::size_t>(part.node)].skin >= 0;
    const glm::dmat4 groupFromMesh =
        isSkinned ? glm::inverse(place.worldFromGroup) : groupFromLevelNode * part.levelFromNode;
    if (isSkinned && !isFinite(groupFromMesh))
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("node {}: a group of levels with skins needs a scale other than 0", place.group));
    const MeshPose pose = part.mesh.posedNode >= 0 ? pose_.meshPose(part.mesh.posedNode) : MeshPose{};
    addPart(part, groupFromMesh, {materials, budget, pose}, result);
  }
  return result;
}

}  // namespace jalousie::asset::detail
