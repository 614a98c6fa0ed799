// The baked format: a discrete LOD chain as MSFT_lod, with what the baker measured in `extras`.
//
// On the LOD 0 node:   extensions.MSFT_lod.ids = [node of LOD 1, node of LOD 2, ...]     (these nodes are in no scene)
//                      extras.MSFT_screencoverage = [c0, c1, ...]                        one per level, descending
//                      The last node may hold nothing: below the threshold before it, the object is not shown.
// On each level's mesh: extras.jalousie = {"format": 6, "lod": k, "triangles": t, "vertices": v, "errorObject": e,
//                      "diagonal": d, "toOriginal": D, "fromOriginal": D, "twoSided": D, "normalDegrees": S, "uv": S,
//                      "coverage": c, "target": e, "stop": "...", "cells": {"triangles": [[n0, n1, ...], ...]},
//                      "faces": {"kind": "masks" or "clusters", "trees": [[n0, n1, ...], 0, ...]},
//                      "cellLevels": {"producers": [...], "groups": [...], "max": [...], "mean": [...]}}
//                      D = {"max", "mean", "maxPercent", "meanPercent"}, S = {"mean", "p95"}
//                      cells: for each primitive the triangles of each cell, in the order of the primitive's triangles
//                      faces: for each primitive its groups of triangles of similar facing (asset/lod_faces.h)
//                      cellLevels: groups of cells that choose a level together (asset/lod_cell_levels.h)
//
// Version history
//   1  first
//   2  everything from "diagonal" to "stop"; files of format 1 are still read
//   3  "cells", which may be absent; files of formats 1 and 2 are still read
//   4  "target", which may be absent; files of formats 1 to 3 are still read
//   5  "faces", which may be absent; files of formats 1 to 4 are still read
//   6  "cellLevels", which may be absent; files of formats 1 to 5 are still read
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace jalousie::asset {

inline constexpr int kLodFormatVersion = 6;

/// Distances from the points of one surface to another, object-space length.
struct DistanceInfo {
  double max = 0.0;
  double mean = 0.0;
};

/// A deviation of an attribute over the surface.
struct SpreadInfo {
  double mean = 0.0;
  double p95 = 0.0;  ///< 95th percentile by area
};

/// What the baker measured of one level against LOD 0, over both surfaces.
struct LodMeasures {
  double diagonal = 0.0;                        ///< of LOD 0's box, object-space length; percentages refer to it
  DistanceInfo toOriginal;                      ///< from the level's points to LOD 0
  DistanceInfo fromOriginal;                    ///< from LOD 0's points to the level
  DistanceInfo twoSided;                        ///< the larger maximum, the mean over the points of both
  SpreadInfo normalDegrees;                     ///< angle between the shading normals of a point and its nearest point
  SpreadInfo uv;                                ///< distance in texture space (TEXCOORD_0), 0 without
  double coverage = 0.0;                        ///< MSFT_screencoverage of this level
  std::string stop;                             ///< last level only: why there is no coarser one
  std::optional<double> target = std::nullopt;  ///< error that was asked for, object-space length
};

/// What the baker knows of one level.
struct LodInfo {
  std::uint32_t lod = 0;  ///< 0 is the finest
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
  double errorObject = 0.0;  ///< deviation from LOD 0, object-space length, ascending along the chain
  std::optional<LodMeasures> measures = std::nullopt;  ///< absent in files of format 1
};

/// For each primitive of a mesh the number of triangles of each cell, in the order of the primitive's triangles. The
/// lists are equally long; numbers may be 0. Empty: the mesh is not divided into cells.
using CellTriangles = std::vector<std::vector<std::uint32_t>>;

/// Writes extras.jalousie of a level's mesh, keeping other extras; those that are no object become extras.value.
/// Cells and groups that were there are removed.
void setLodInfo(tinygltf::Mesh& mesh, const LodInfo& info);
/// Reads it back; nullopt if absent. Errors: kMalformed (wrong types, negative, a mean above its maximum, unknown
/// format version).
std::optional<LodInfo> lodInfo(const tinygltf::Mesh& mesh);

/// Adds the cells to extras.jalousie. @pre setLodInfo with measures was called (checked); a list for each primitive
void setLodCells(tinygltf::Mesh& mesh, const CellTriangles& cells);
/// Reads them back; empty if absent. Errors: kMalformed (wrong types, not one list for each primitive, lists that
/// differ in length, a list whose sum is not the number of its primitive's triangles).
/// @pre the indices of the mesh's accessors are in range
CellTriangles lodCells(const tinygltf::Model& model, const tinygltf::Mesh& mesh);
/// Number of cells of a mesh, 0 if it is not divided. @param cells  as lodCells returns them
inline std::size_t cellCount(const CellTriangles& cells) {
  return cells.empty() ? 0 : cells.front().size();
}

/// Makes node the LOD 0 of a chain. @param lowerNodes  nodes of LOD 1, 2, ...  @param coverage  one per level, LOD 0
/// first: the share of the screen's area below which the next level may be shown (MSFT_screencoverage); empty: none.
/// Declares
/// MSFT_lod in model.extensionsUsed.
void setLodChain(tinygltf::Model& model, int node, std::span<const int> lowerNodes, std::span<const float> coverage);
/// Node indices of LOD 1, 2, ... as MSFT_lod lists them; empty without. A last node that holds nothing is left out: see
/// emptyLevel. Errors: kMalformed (index out of range, a node twice or itself, another node with neither a mesh nor
/// nodes below it).
std::vector<int> lodIds(const tinygltf::Model& model, int node);
/// The last node that MSFT_lod lists, if it has neither a mesh nor nodes below it: the coarsest level shows nothing. -1
/// without. Errors: as lodIds.
int emptyLevel(const tinygltf::Model& model, int node);
/// Whether the levels of a node are groups: the node or one of them has no mesh of its own. Each level then stands for
/// all meshes below its node. Else the levels are single meshes. Errors: as lodIds.
bool isLodGroup(const tinygltf::Model& model, int node);
/// lodIds of a chain of single meshes; empty for a group. Errors: as lodIds.
std::vector<int> lodNodes(const tinygltf::Model& model, int node);
/// extras.MSFT_screencoverage as it is, with 0 for what is no number; empty if absent.
std::vector<float> lodCoverage(const tinygltf::Node& node);
/// The same for choosing levels: for each of the first levels the least share of the screen at which it is drawn.
/// Empty if it is absent or broken: not all numbers are finite and at least 0, or one is larger than the one before it.
/// @param levels  of the chain; values beyond them are left out
std::vector<float> lodThresholds(const tinygltf::Node& node, std::size_t levels);

/// What tells chains apart: nodes with equal keys share a chain.
template <class Level>
struct ChainKey {
  std::vector<Level> levels;
  std::vector<float> coverage;  ///< lodThresholds

  friend bool operator<(const ChainKey& a, const ChainKey& b) {
    return std::tie(a.levels, a.coverage) < std::tie(b.levels, b.coverage);
  }
};

}  // namespace jalousie::asset
