// Animations as the arrays that the kernels read.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "asset/scene_types.h"
#include "scene/loose_table.h"
#include "shared/motion_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {

/// What plays a scene's animations. Kernels write the transforms, vertices and boxes that follow from a time.
struct MotionData {
  float lastKey = 0.0F;  ///< seconds; later, all rests
  std::vector<float> numbers;
  std::vector<gpu::MotionTrack> tracks;
  std::vector<gpu::MotionNode> nodes;
  std::vector<gpu::MotionWeight> weights;
  std::vector<gpu::MotionTarget> targets;  ///< of transforms, then of joints
  std::uint32_t transformCount = 0;        ///< how many of the targets write transforms
  std::vector<gpu::BentVertex> vertices;
  std::vector<gpu::Influence> influences;
  std::vector<gpu::MorphDelta> deltas;
  std::vector<gpu::BentChain> chains;
  std::vector<gpu::BentBox> boxes;
  std::vector<gpu::CellBounds> deltaBoxes;
  /// Of the scene's vertices, destinations are relative to this one, a multiple of kVertexAlignment.
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexEnd = 0;  ///< behind the last destination, in the scene's vertices

  std::uint32_t jointCount() const { return static_cast<std::uint32_t>(targets.size()) - transformCount; }
  bool empty() const { return targets.empty() && vertices.empty(); }
  /// Of all arrays.
  std::uint64_t bytes() const;
};

/// The offset of a buffer range is a multiple of 256 bytes on every driver.
inline constexpr std::uint32_t kVertexAlignment = 256 / (4 * gpu::kVertexWords);

/// Vertices of a mesh in the scene's vertex buffer.
struct MeshPlace {
  std::uint32_t baseVertex = 0;
  std::vector<std::uint32_t> offsets;  ///< of each primitive, relative to baseVertex
};

/// The base mesh of the tessellation path of a chain.
struct PatchPlace {
  MeshPlace vertices;
  std::vector<std::vector<glm::vec3>> normals;  ///< per primitive, before a pose bends them
};

/// Where a scene that was built has what moves.
struct MotionPlaces {
  std::vector<MeshPlace> meshes;                   ///< by SceneFile::meshes
  std::vector<std::optional<PatchPlace>> patches;  ///< by chain, where it is bent and has a base mesh
  std::vector<std::uint32_t> transforms;           ///< by SceneFile::instances; kNoMotion: it is hidden
  std::vector<std::uint32_t> cellChains;           ///< first one of each chain; empty without cells
  std::span<const gpu::Chain> chainsOfCells;       ///< CellTables::chains
  std::span<const LoosePlace> loose;               ///< by SceneFile::looseInstances
};

/// Whether animations bend each mesh of a file.
std::vector<bool> bentMeshes(const asset::SceneFile& file);
/// A mesh without its pose. @pre bending is the mesh's
asset::Mesh unbent(const asset::Mesh& mesh, const asset::MeshBending& bending);

/// Errors: kLimit if an array exceeds 32-bit indices.
MotionData buildMotion(const asset::SceneFile& file, const MotionPlaces& places);

}  // namespace jalousie::scene
