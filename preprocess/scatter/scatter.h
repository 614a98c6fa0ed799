// Builds a scattered scene as one glTF model.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

#include "core/aabb.h"
#include "core/progress.h"
#include "scatter/options.h"

namespace jalousie::scatter {

/// Figures of the scene.
struct Summary {
  float side = 0.0F;                     ///< world units
  std::uint32_t levels = 0;              ///< of the LOD chain
  std::uint64_t trianglesPerObject = 0;  ///< LOD 0
  std::uint64_t trianglesFull = 0;       ///< LOD 0 of all objects and the occluder
  std::uint64_t occluderTriangles = 0;
  Aabb boundsWorld;  ///< objects and occluder
};

struct ScatteredScene {
  tinygltf::Model model;
  Summary summary;
};

/// Builds the scene: instances on the nodes of the chain, the occluder, the animated camera. The input's meshes,
/// materials and images are copied; its other nodes, cameras and animations are not. Errors: as findSourceChain;
/// kUsage if lengths are not representable with the input's size.
ScatteredScene scatterObjects(tinygltf::Model input, const Options& options, Progress& progress);

}  // namespace jalousie::scatter
