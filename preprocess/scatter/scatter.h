// Builds a scattered scene as one glTF model.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

#include "asset/scene_types.h"
#include "core/aabb.h"
#include "core/progress.h"
#include "scatter/options.h"

namespace jalousie::scatter {

/// Figures of the scene.
struct Summary {
  float side = 0.0F;                     ///< of the cube or the ground, world units
  std::uint32_t moving = 0;              ///< objects that bounce
  std::uint32_t levels = 0;              ///< of the longest LOD chain
  std::uint64_t meshesPerObject = 0;     ///< instances of meshes that an object consists of
  std::uint64_t trianglesPerObject = 0;  ///< LOD 0
  std::uint64_t trianglesFull = 0;       ///< LOD 0 of objects, occluder, buildings and ground
  std::uint64_t occluderTriangles = 0;
  std::uint64_t groundTriangles = 0;
  std::uint32_t blocks = 0;  ///< of a city, along a side
  std::uint64_t buildings = 0;
  std::uint64_t buildingBoxes = 0;  ///< of all buildings
  std::uint64_t buildingTriangles = 0;
  Aabb boundsWorld;              ///< objects, occluder, buildings and ground
  asset::ContentCounts ignored;  ///< what of the input is left out
};

struct ScatteredScene {
  tinygltf::Model model;
  Summary summary;
};

/// Builds the scene: instances of all meshes of the input with their chains, the occluder, the animated camera. The
/// input's materials and images are copied; its cameras, lights, skins and animations are not. Errors: as
/// findSourceAsset; kUsage if lengths are not representable with the input's size.
ScatteredScene scatterObjects(tinygltf::Model input, const Options& options, Progress& progress);

}  // namespace jalousie::scatter
