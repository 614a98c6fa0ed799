// Finds and prints the LOD chains of any glTF file.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "asset/scene_types.h"

namespace jalousie::bake {

/// Cells of one level, all primitives together.
struct InspectedCells {
  std::uint64_t count = 0;    ///< the same for all levels of a chain; 0: not divided
  std::uint64_t filled = 0;   ///< with triangles of this level
  std::uint64_t largest = 0;  ///< triangles
};

/// Groups of cells that choose a level together, of one level.
struct InspectedGroups {
  std::uint64_t count = 0;      ///< 0: there are none, or the level is the last one
  std::uint64_t mostCells = 0;  ///< of one group
  asset::DistanceInfo least;    ///< smallest stored maximum and mean of a group, object-space length
  asset::DistanceInfo largest;
};

/// Groups of triangles that face alike, of all primitives.
struct InspectedFaces {
  asset::FaceGrouping grouping = asset::FaceGrouping::kOff;  ///< kOff: there are none
  std::uint64_t groups = 0;
  std::uint64_t triangles = 0;  ///< in groups; the others are left whole
  std::uint64_t largest = 0;    ///< triangles of the largest group
};

struct InspectedLevel {
  int mesh = -1;
  std::uint64_t triangles = 0;         ///< of indexed and plain lists, strips and fans
  std::uint64_t vertices = 0;          ///< sum of the primitives' POSITION counts
  std::optional<asset::LodInfo> info;  ///< what our baker wrote; absent in other tools' files
  InspectedCells cells;
  InspectedGroups groups;
  InspectedFaces faces;
};

/// LOD 0 first. A mesh without MSFT_lod is a chain of one level.
struct InspectedChain {
  std::string name;         ///< of the mesh, or its number
  std::uint64_t nodes = 0;  ///< that show LOD 0's mesh
  std::vector<InspectedLevel> levels;
  std::vector<float> coverage;  ///< MSFT_screencoverage, may be empty
  bool endsInNothing = false;   ///< the last level shows nothing; it is none of the levels
  std::vector<asset::Occluder> occluders;
};

/// Chains by the meshes of their LOD 0, in the order of the meshes.
/// Errors: kMalformed (of lodNodes, lodInfo, lodCells, lodCellLevels and lodFaces).
std::vector<InspectedChain> inspectModel(const tinygltf::Model& model);

/// One table per chain; '-' for figures that the file does not store. Behind them a line for each room.
std::string inspectText(const std::vector<InspectedChain>& chains, const RoomPlan& rooms = {});
/// {"chains": [{"name", "nodes", "ends_in_nothing", "occluders": [{"vertices", "faces", "levels", "min", "max"}] (where
///   there are any), "levels": [{"lod", "triangles", "vertices", "screen_coverage", and, where the file says,
///   "error_object", "error_percent", "target_object", "target_percent", "mean_percent",
///   "normal_degrees": {"mean", "p95"}, "uv": {"mean", "p95"},
///   "stop", "cells": {"count", "filled", "largest", "mean"},
///   "cell_levels": {"groups", "most_cells", "max_percent": [least, largest], "mean_percent": [least, largest]},
///   "faces": {"kind", "groups", "triangles", "largest"}}]}],
///  "rooms": [{"name", "min", "max", "points", "portals"}], "portals": count (both where the file has rooms)}
std::string inspectJson(const std::vector<InspectedChain>& chains, const RoomPlan& rooms = {});

}  // namespace jalousie::bake
