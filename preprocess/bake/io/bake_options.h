// Options that decide on the content of a baked document.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "asset/face_groups.h"
#include "asset/gltf_file.h"
#include "bake/io/level_cells.h"
#include "bake/simplify/chain_options.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

struct BakeOptions {
  ChainOptions chain;
  std::uint32_t subdivide = 0;      ///< Loop steps before anything else
  std::optional<double> hardAngle;  ///< rebuild normals: edges that bend by more degrees stay hard
  double weld = 0.0;                ///< weld vertices that are at most this far apart, object units
  bool sceneBudget = true;          ///< ratios hold for all meshes together; not for the preset draft
  bool quantized = false;           ///< the document is quantised later: targets of error leave room for its rounding
  std::vector<glm::vec3> locked;    ///< places of vertices that stay, ascending; object space of the one mesh
  bool occluders = false;           ///< find convex solids inside closed meshes
  bool keepUnused = false;          ///< keep attributes that no material uses in every level
  ScreenTolerance screen;           ///< for MSFT_screencoverage
  CellOptions cells;
  asset::FaceGrouping faces = asset::FaceGrouping::kOff;  ///< groups of triangles that face alike
  asset::Limits limits;
  TaskRunner tasks = runInOrder;  ///< bakes small meshes side by side; the result does not depend on it
};

}  // namespace jalousie::bake
