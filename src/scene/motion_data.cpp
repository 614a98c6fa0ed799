// Vertices, influences and boxes of bent meshes, one after another.
#include "scene/motion_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/aabb.h"
#include "core/check.h"
#include "core/error.h"
#include "scene/patch_base.h"

namespace jalousie::scene {
namespace {

using asset::MeshBending;
using asset::PrimitiveBending;

template <class T>
std::uint64_t bytesOf(const std::vector<T>& elements) {
  return elements.size() * sizeof(T);
}

template <class T>
std::uint32_t sizeOf32(const std::vector<T>& elements) {
  if (elements.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::kLimit, "the scene's animations have more elements than 32-bit offsets reach");
  return static_cast<std::uint32_t>(elements.size());
}

gpu::CellBounds boundsOf(const Aabb& box) {
  return {glm::vec4(box.min, 0.0F), glm::vec4(box.max, 0.0F)};
}

Aabb boxOf(const asset::Mesh& mesh) {
  Aabb box;
  for (const asset::Primitive& primitive : mesh.primitives)
    for (const glm::vec3& position : primitive.positions)
      box.add(position);
  return box;
}

/// The vertices that one joint influences, and what morph targets add to them.
struct JointBox {
  Aabb box;
  std::vector<Aabb> deltas;

  void add(const PrimitiveBending& bending, std::size_t v) {
    // Vertices that were added without these targets are not moved by them.
    if (deltas.size() < bending.targets)
      deltas.resize(bending.targets, box.empty() ? Aabb{} : Aabb{glm::vec3(0.0F), glm::vec3(0.0F)});
    box.add(bending.positions[v]);
    for (std::uint32_t t = 0; t < deltas.size(); ++t)
      deltas[t].add(t < bending.targets ? glm::vec3(bending.deltas[t * bending.positions.size() + v].position)
                                        : glm::vec3(0.0F));
  }
};

class MotionBuilder {
 public:
  MotionBuilder(const asset::SceneFile& file, const MotionPlaces& places) : file_(file), places_(places) {
    for (const MeshBending& bending : file.motion.meshes)
      bendings_[bending.mesh] = &bending;
  }

  MotionData build() {
    const asset::SceneMotion& motion = file_.motion;
    result_.lastKey = motion.lastKey;
    result_.numbers = motion.numbers;
    result_.tracks = motion.tracks;
    result_.nodes = motion.nodes;
    result_.weights = motion.weights;
    for (const asset::Follower& follower : motion.instances) {
      const std::uint32_t transform = places_.transforms[follower.index];
      if (transform != gpu::kNoMotion) addTarget(follower.target, transform);
    }
    result_.transformCount = sizeOf32(result_.targets);
    for (const gpu::MotionTarget& joint : motion.joints)
      addTarget(joint, joint.destination);
    for (const asset::Follower& follower : motion.looseInstances)
      addLoose(follower);
    for (const MeshBending& bending : motion.meshes)
      addVertices(bending, places_.meshes[bending.mesh], nullptr);
    for (std::uint32_t chain = 0; chain < file_.chains.size(); ++chain)
      addChain(chain);
    alignVertices();
    return std::move(result_);
  }

 private:
  void addTarget(gpu::MotionTarget target, std::uint32_t destination) {
    target.destination = destination;
    result_.targets.push_back(target);
  }

  /// A vertex that follows one joint.
  void addRigidVertex(const asset::LooseVertex& source, std::uint32_t destination, std::uint32_t influence) {
    gpu::BentVertex vertex{};
    vertex.position = glm::vec4(source.position, 0.0F);
    vertex.normal = glm::vec4(source.normal, 0.0F);
    vertex.destination = destination;
    vertex.flags = gpu::kBentLoose | gpu::kBentSkinned;
    vertex.firstInfluence = influence;
    vertex.influenceCount = 1;
    result_.vertices.push_back(vertex);
  }

  void addLoose(const asset::Follower& follower) {
    const LoosePlace& place = places_.loose[follower.index];
    if (!place.isShown) return;
    const asset::LooseGeometry& geometry = file_.looseGeometries[file_.looseInstances[follower.index].geometry];
    const std::uint32_t influence = sizeOf32(result_.influences);
    result_.influences.push_back({result_.jointCount(), 1.0F});
    addTarget(follower.target, result_.jointCount());
    for (std::uint32_t v = 0; v < geometry.lines.size(); ++v)
      addRigidVertex(geometry.lines[v], place.firstLine + v, influence);
    for (std::uint32_t v = 0; v < geometry.points.size(); ++v)
      addRigidVertex(geometry.points[v], place.firstPoint + v, influence);
  }

  /// @param normals  per primitive, instead of the mesh's own; may be null
  void addVertices(const MeshBending& bending, const MeshPlace& place,
                   const std::vector<std::vector<glm::vec3>>* normals) {
    for (std::size_t p = 0; p < bending.primitives.size(); ++p)
      addPrimitive(bending, p, place.baseVertex + place.offsets[p], normals != nullptr ? &(*normals)[p] : nullptr);
  }

  void addPrimitive(const MeshBending& bending, std::size_t p, std::uint32_t destination,
                    const std::vector<glm::vec3>* own) {
    const PrimitiveBending& source = bending.primitives[p];
    const std::vector<glm::vec3>& normals = own != nullptr ? *own : source.normals;
    const std::uint32_t firstInfluence = sizeOf32(result_.influences);
    const std::uint32_t firstDelta = sizeOf32(result_.deltas);
    result_.influences.insert(result_.influences.end(), source.influences.begin(), source.influences.end());
    result_.deltas.insert(result_.deltas.end(), source.deltas.begin(), source.deltas.end());
    sizeOf32(result_.influences);
    sizeOf32(result_.deltas);
    const auto count = static_cast<std::uint32_t>(source.positions.size());
    for (std::uint32_t v = 0; v < count; ++v) {
      gpu::BentVertex vertex{};
      vertex.position = glm::vec4(source.positions[v], 0.0F);
      if (!normals.empty()) vertex.normal = glm::vec4(normals[v], 0.0F);
      vertex.destination = destination + v;
      vertex.flags = (source.isSkinned ? gpu::kBentSkinned : 0U) |
                     (normals.empty() ? gpu::kBentFlat | v % 3 << gpu::kBentCornerShift : 0U);
      if (source.isSkinned) {
        vertex.firstInfluence = firstInfluence + source.firstInfluence[v];
        vertex.influenceCount = source.firstInfluence[v + 1] - source.firstInfluence[v];
      }
      vertex.firstDelta = firstDelta + v;
      vertex.deltaStride = count;
      vertex.targetCount = source.targets;
      vertex.firstWeight = bending.firstWeight;
      result_.vertices.push_back(vertex);
    }
  }

  void addChain(std::uint32_t index) {
    const asset::Chain& chain = file_.chains[index];
    if (std::none_of(chain.levels.begin(), chain.levels.end(),
                     [&](const asset::LodLevel& level) { return bendings_.contains(level.mesh); }))
      return;
    gpu::BentChain bent{};
    bent.chain = index;
    bent.firstBox = sizeOf32(result_.boxes);
    bent.leastSum = std::numeric_limits<float>::infinity();
    for (const asset::LodLevel& level : chain.levels) {
      const auto bending = bendings_.find(level.mesh);
      if (bending != bendings_.end()) {
        addBoxes(*bending->second, bent);
      } else {
        addBox({boxOf(file_.meshes[level.mesh]), {}}, gpu::kNoMotion, 0);
        addSum(1.0F, bent);
      }
    }
    bent.boxCount = sizeOf32(result_.boxes) - bent.firstBox;
    addPatches(index, bent);
    bent.cellChain = gpu::kNoMotion;
    if (!places_.cellChains.empty()) {
      bent.cellChain = places_.cellChains[index];
      bent.firstCellLod = places_.chainsOfCells[bent.cellChain].firstLod;
      bent.cellLodCount = places_.chainsOfCells[bent.cellChain].lodCount;
    }
    result_.chains.push_back(bent);
  }

  /// A curved triangle leaves its plane by less than the share alpha of its longest edge (phongPoint).
  void addPatches(std::uint32_t chain, gpu::BentChain& bent) {
    if (places_.patches.empty() || !places_.patches[chain]) return;
    const PatchPlace& patch = *places_.patches[chain];
    const std::uint32_t mesh = file_.chains[chain].levels.back().mesh;
    const MeshBending& bending = *bendings_.at(mesh);
    addVertices(bending, patch.vertices, &patch.normals);
    bent.bulge = kPhongAlpha;
    for (std::size_t p = 0; p < bending.primitives.size(); ++p)
      addEdges(file_.meshes[mesh].primitives[p].indices, bending.primitives[p], bent);
  }

  static void addEdges(const std::vector<std::uint32_t>& indices, const PrimitiveBending& primitive,
                       gpu::BentChain& bent) {
    if (primitive.targets > 0) bent.weightStep = 1.0F;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::uint32_t a = indices[i];
      const std::uint32_t b = indices[i % 3 == 2 ? i - 2 : i + 1];
      bent.longestEdge = std::max(bent.longestEdge, glm::distance(primitive.positions[a], primitive.positions[b]));
      if (primitive.isSkinned) bent.weightStep = std::max(bent.weightStep, weightStep(primitive, a, b));
    }
  }

  /// Half the sum of the differences of two vertices' weights.
  static float weightStep(const PrimitiveBending& primitive, std::uint32_t a, std::uint32_t b) {
    std::map<std::uint32_t, float> differences;
    for (std::uint32_t i = primitive.firstInfluence[a]; i < primitive.firstInfluence[a + 1]; ++i)
      differences[primitive.influences[i].joint] += primitive.influences[i].weight;
    for (std::uint32_t i = primitive.firstInfluence[b]; i < primitive.firstInfluence[b + 1]; ++i)
      differences[primitive.influences[i].joint] -= primitive.influences[i].weight;
    float sum = 0.0F;
    for (const auto& [joint, difference] : differences)
      sum += 0.5F * std::abs(difference);
    return sum;
  }

  static void addSum(float sum, gpu::BentChain& bent) {
    bent.leastSum = std::min(bent.leastSum, sum);
    bent.mostSum = std::max(bent.mostSum, sum);
  }

  void addBoxes(const MeshBending& bending, gpu::BentChain& bent) {
    std::map<std::uint32_t, JointBox> joints;
    for (const PrimitiveBending& primitive : bending.primitives) {
      for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        if (!primitive.isSkinned) {
          joints[gpu::kNoMotion].add(primitive, v);
          addSum(1.0F, bent);
          continue;
        }
        float sum = 0.0F;
        for (std::uint32_t i = primitive.firstInfluence[v]; i < primitive.firstInfluence[v + 1]; ++i) {
          joints[primitive.influences[i].joint].add(primitive, v);
          sum += primitive.influences[i].weight;
        }
        addSum(sum * (sum < 1.0F ? 1.0F - gpu::kBentRounding : 1.0F + gpu::kBentRounding), bent);
      }
    }
    if (joints.empty()) joints[gpu::kNoMotion].box.add(glm::vec3(0.0F));  // no vertex has an influence
    for (const auto& [joint, box] : joints)
      addBox(box, joint, bending.firstWeight);
  }

  void addBox(const JointBox& source, std::uint32_t joint, std::uint32_t firstWeight) {
    const gpu::CellBounds box = boundsOf(source.box);
    result_.boxes.push_back({box.minObject, box.maxObject, joint, sizeOf32(result_.deltaBoxes),
                             static_cast<std::uint32_t>(source.deltas.size()), firstWeight});
    for (const Aabb& delta : source.deltas)
      result_.deltaBoxes.push_back(boundsOf(delta));
  }

  /// Makes the destinations relative to the first one, so that a driver need not address all vertices.
  void alignVertices() {
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    const auto isLoose = [](const gpu::BentVertex& vertex) { return (vertex.flags & gpu::kBentLoose) != 0; };
    for (const gpu::BentVertex& vertex : result_.vertices) {
      if (isLoose(vertex)) continue;
      first = std::min(first, vertex.destination);
      result_.vertexEnd = std::max(result_.vertexEnd, vertex.destination + 1);
    }
    if (result_.vertexEnd == 0) return;
    result_.firstVertex = first / kVertexAlignment * kVertexAlignment;
    for (gpu::BentVertex& vertex : result_.vertices)
      if (!isLoose(vertex)) vertex.destination -= result_.firstVertex;
  }

  const asset::SceneFile& file_;
  const MotionPlaces& places_;
  std::map<std::uint32_t, const MeshBending*> bendings_;  ///< by mesh
  MotionData result_;
};

}  // namespace

std::uint64_t MotionData::bytes() const {
  return bytesOf(numbers) + bytesOf(tracks) + bytesOf(nodes) + bytesOf(weights) + bytesOf(targets) + bytesOf(vertices) +
         bytesOf(influences) + bytesOf(deltas) + bytesOf(chains) + bytesOf(boxes) + bytesOf(deltaBoxes);
}

std::vector<bool> bentMeshes(const asset::SceneFile& file) {
  std::vector<bool> bent(file.meshes.size(), false);
  for (const MeshBending& bending : file.motion.meshes)
    bent[bending.mesh] = true;
  return bent;
}

asset::Mesh unbent(const asset::Mesh& mesh, const MeshBending& bending) {
  JAL_CHECK(mesh.primitives.size() == bending.primitives.size());
  asset::Mesh result = mesh;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
    result.primitives[p].positions = bending.primitives[p].positions;
  return result;
}

MotionData buildMotion(const asset::SceneFile& file, const MotionPlaces& places) {
  if (file.motion.empty()) return {};
  return MotionBuilder(file, places).build();
}

}  // namespace jalousie::scene
