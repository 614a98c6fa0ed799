// Which meshes of a file are divided into cells, and where their triangles go.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/scene_types.h"
#include "scene/cell_options.h"

namespace jalousie::scene {

/// The triangles of one mesh in the order of its cells. All levels of a chain have equally many cells.
struct MeshCells {
  std::uint32_t count = 1;  ///< 1: the mesh is not divided, and the vectors are empty
  /// Per primitive the indices in the order of the cells; empty where the file's order is that order.
  std::vector<std::vector<std::uint32_t>> indices;
  /// Per primitive and cell the first index behind the cell's triangles.
  std::vector<std::vector<std::uint32_t>> ends;
};

/// Chooses the chains that are divided, and divides their meshes. A chain that shares a mesh with another one keeps the
/// file's cells, or has none. Errors: kLimit with CellOptions::Kind::kCount if there were more than kMostCells cells.
/// @return  per mesh of the file
std::vector<MeshCells> divideMeshes(const asset::SceneFile& file, const CellOptions& options);

}  // namespace jalousie::scene
