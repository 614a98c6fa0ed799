// Conversion of glTF meshes to indexed triangles with complete attributes.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// What may still be read into one scene; taken from Limits::maxAccessorElements for all meshes together.
struct ElementBudget {
  std::uint64_t left;
  /// Errors: kLimit.
  void take(std::uint64_t elements);
};

/// Reads the triangles of a mesh. Primitives without triangles (points, lines, no POSITION) are left out.
/// @param defaultMaterial  index for primitives that name none
/// @param skipped          grows by the number of point and line primitives
/// Errors: kMalformed, kLimit.
Mesh readMesh(const tinygltf::Model& model, int mesh, std::uint32_t defaultMaterial, ElementBudget& budget,
              std::uint32_t& skipped);

}  // namespace jalousie::asset::detail
