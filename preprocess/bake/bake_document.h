// Gives every mesh of a document its LOD chain.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "bake/chain.h"
#include "bake/clean.h"

namespace jalousie::bake {

struct BakeOptions {
  ChainOptions chain;
  std::uint32_t subdivide = 0;  ///< Loop steps before anything else
  asset::Limits limits;
};

/// One level as it was written.
struct LevelReport {
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
  double errorObject = 0.0;  ///< largest two-sided distance to LOD 0, object-space length
  double errorMean = 0.0;
  float screenCoverage = 0.0F;
};

struct MeshReport {
  std::string name;
  double diagonal = 0.0;            ///< of LOD 0's box
  std::vector<LevelReport> levels;  ///< empty if the mesh was passed through
  std::string stopReason;
  std::string passedThrough;  ///< why, if it was
  CleanCounts cleaned;
  std::uint64_t nodes = 0;  ///< that use it
};

/// Bakes every mesh that a node uses, once; nodes that share a mesh share its levels. Lower levels are nodes in no
/// scene with the same transform (and instances). Everything else in the document stays as it is. @param progress
/// meshes done, of how many Errors: kMalformed, kUnsupported, kLimit, each naming the mesh.
std::vector<MeshReport> bakeDocument(tinygltf::Model& model, const BakeOptions& options,
                                     const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace jalousie::bake
