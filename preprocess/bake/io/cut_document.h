// Replaces chains of levels by meshes whose cells have levels of their own, chosen for one eye or one error.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asset/cell_cut.h"
#include "asset/read_limits.h"

namespace jalousie::bake {

struct CutOptions {
  std::optional<glm::dvec3> eye;  ///< in the scene; absent: one error everywhere
  double pixels = 1.0;            ///< largest error on the screen, with an eye
  double height = 1080.0;         ///< of the screen, pixels
  double fieldOfView = 60.0;      ///< vertical, degrees
  double errorPercent = 0.1;      ///< of the diagonal of LOD 0, without an eye
  asset::CutBy by = asset::CutBy::kLargest;
  asset::Limits limits;
};

/// What became of the chain of one node.
struct CutNode {
  std::string name;                   ///< of the mesh
  std::string leftBecause;            ///< why the chain stays; empty if it was cut
  std::uint64_t triangles = 0;        ///< of the cut
  std::uint64_t wholeTriangles = 0;   ///< of the coarsest whole level within the same limit
  std::uint64_t finestTriangles = 0;  ///< of LOD 0
  std::size_t wholeLevel = 0;
  std::vector<std::uint32_t> cells;  ///< drawn cells by level
};

/// Gives every node with a chain whose cells have levels a mesh of its own: a primitive for each level and primitive
/// that the cut draws, with the vertices of that level. The levels of these nodes hold nothing afterwards. Meshes have
/// no cracks and no overlap between cells. @return  the nodes with chains, in their order
/// Errors: kLimit, kMalformed, kUnsupported (triangles of a divided level are no list).
std::vector<CutNode> cutDocument(tinygltf::Model& model, const CutOptions& options);

/// One line for each node, and a JSON document:
/// {"nodes": [{"name", "triangles", "triangles_whole", "lod_whole", "triangles_finest", "cells": [by level]} or
/// {"name", "left"}]}
std::string cutText(const std::vector<CutNode>& nodes);
std::string cutJson(const std::vector<CutNode>& nodes);

}  // namespace jalousie::bake
