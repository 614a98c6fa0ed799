// A scene as flat arrays ready for the GPU; needs no OpenGL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "asset/scene_types.h"
#include "core/aabb.h"
#include "core/room_plan.h"
#include "scene/bin_layout.h"
#include "scene/cell_options.h"
#include "scene/face_tables.h"
#include "scene/loose_table.h"
#include "scene/motion_data.h"
#include "scene/scene_names.h"
#include "scene/texture_layers.h"
#include "scene/transform.h"
#include "scene/vertex.h"
#include "shared/limits.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {

/// What draw lists are made of: objects, or the cells of objects.
struct DrawTables {
  std::vector<gpu::Object> objects;  ///< sorted by chain; within a chain in the file's order
  std::vector<gpu::Chain> chains;
  std::vector<gpu::Lod> lods;
  BinLayout binLayout;
};

/// The cells of all objects: an object whose chain is not divided is one cell. Empty if no chain is divided.
struct CellTables : DrawTables {
  std::vector<gpu::CellBounds> bounds;  ///< [lods.size()]
};

/// An occluder of all objects of a chain.
struct ChainOccluder {
  ConvexSolid solid;        ///< object space
  std::uint32_t chain = 0;  ///< index into SceneData::chains
  bool everyLevel = false;  ///< it lies inside every level; false: at least inside LOD 0
};

/// Everything the GPU needs of a scene. All chains share one vertex and one index buffer.
struct SceneData : DrawTables {
  std::vector<Vertex> vertices;
  std::vector<glm::vec2> secondUvs;  ///< TEXCOORD_1 [vertices.size()], zeros where unused; empty if no texture uses it
  std::vector<std::uint32_t> indices;
  std::vector<gpu::Transform> transforms;  ///< by Object::transform; buildScene makes one per object
  LooseTable loose;
  MotionData motion;                     ///< empty if nothing moves
  std::vector<ChainOccluder> occluders;  ///< ascending by chain
  RoomPlan rooms;                        ///< as asset::SceneFile
  std::vector<gpu::Material> materials;
  TextureLayers textures;
  std::vector<asset::Camera> cameras;
  glm::dvec3 originWorld{0.0};  ///< as asset::SceneFile
  SceneNames names;
  asset::ContentCounts ignored;  ///< what the file holds that is not drawn
  CellTables cells;  ///< if not empty, the index ranges of SceneData::lods are mixed: only cells can be drawn
  FaceTables faces;  ///< of what is drawn; empty unless BuildOptions::faces
  Aabb boundsWorld;  ///< of all objects, points and lines, also where animations take them
  bool usesFullMaterials = false;       ///< a material has more than a base colour with a texture that isPlain()
  bool usesBlending = false;            ///< whether any level has blended triangles
  bool hasUnmeasuredLevels = false;     ///< some level's error is unknown (infinite): never chosen by pixel error
  bool hasUncoveredChains = false;      ///< some chain with several levels has no thresholds: always LOD 0 by coverage
  std::uint32_t maxPatchTriangles = 0;  ///< of the largest base mesh of the tessellation path; 0 without patches

  /// What is drawn: the cells, or the objects where there are none.
  const DrawTables& drawn() const { return cells.objects.empty() ? *static_cast<const DrawTables*>(this) : cells; }
};

/// What the arrays are made for.
struct BuildOptions {
  /// Adds the base meshes of the tessellation path (the coarsest level of each chain, normals averaged per position)
  /// and widens the boxes to hold the curved surface. Off, patchLod repeats the coarsest level.
  bool patches = false;
  /// Divides chains into cells that are culled one by one. Ignored with patches.
  CellOptions cells = {};
  /// Makes SceneData::faces. Ignored with patches.
  bool faces = false;
  /// Instances that the scene does not get, ascending. The others keep their gpu::Object::owner, and the bounds of the
  /// scene hold all, so that the cameras stay where they are.
  std::vector<std::uint32_t> hidden = {};

  friend bool operator==(const BuildOptions&, const BuildOptions&) = default;
};

/// Flattens a file. Errors: kLimit if vertices or indices exceed 32-bit offsets, kUnsupported above kMaxLods levels.
SceneData buildScene(const asset::SceneFile& file, const BuildOptions& options = {});

}  // namespace jalousie::scene
