// Groups of triangles of similar facing, as the kernels test them (docs/back_faces.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asset/face_groups.h"
#include "asset/scene_types.h"
#include "scene/vertex.h"
#include "shared/face_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {

/// Groups of everything that is drawn: of the objects, or of the cells where the scene has cells.
struct FaceTables {
  std::vector<gpu::FaceNode> nodes;
  std::vector<gpu::FaceLod> lods;    ///< [drawn().lods.size()]
  std::vector<gpu::FaceUnit> units;  ///< [drawn().objects.size()]
  std::uint32_t mostGroups = 0;      ///< of one level

  bool empty() const { return units.empty(); }
};

/// Geometry that the ranges of levels refer to.
struct FaceGeometry {
  std::span<const Vertex> vertices;
  std::span<const std::uint32_t> indices;
};

/// Adds the groups of one level. The numbers of a node are those of its triangles, rounded so that nothing is culled
/// that exact numbers would not cull.
/// @param trees  of its solid triangles; empty: the level is left whole
void addFaceLod(FaceTables& tables, const FaceGeometry& geometry, const gpu::Lod& lod,
                std::span<const std::uint32_t> trees);

/// The trees of the triangles of one primitive, cell by cell. Where the file has no groups, or the cells are not in its
/// order, the triangles of a cell are one group.
/// @param ends  per cell the first index behind its triangles   @param fileOrder  the triangles are in the file's order
std::vector<asset::FaceTree> faceTreesOf(const asset::Primitive& primitive, std::span<const std::uint32_t> ends,
                                         bool fileOrder);

/// Rectangle of the cells of normals, as gpu::FaceNode::normals. @param normals  none is 0
gpu::uint normalRectangle(std::span<const asset::Facet> facets);

}  // namespace jalousie::scene
