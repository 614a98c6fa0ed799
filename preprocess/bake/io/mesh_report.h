// What a bake reports about one mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asset/lod_chain.h"
#include "bake/mesh/clean.h"

namespace jalousie::bake {

/// What was found in a mesh before it was simplified.
struct MeshFindings {
  CleanCounts cleaned;
  std::uint64_t repairedValues = 0;    ///< NaN or infinite numbers in attributes, now 0
  std::uint64_t nonManifoldEdges = 0;  ///< of three and more triangles, or of two that run the same way; passed on
  std::uint64_t openEdges = 0;
  std::uint64_t nearlyWelded = 0;  ///< vertices of open edges that lie within weldHint of another one
  double weldHint = 0.0;           ///< object units
  std::uint64_t looseParts = 0;
  std::vector<std::string> unusedAttributes;  ///< that no material uses; coarser levels are without them
};

struct MeshReport {
  std::string name;
  double diagonal = 0.0;                    ///< of LOD 0's box
  std::vector<asset::LodInfo> levels;       ///< as written, with measures; empty if the mesh was passed through
  std::vector<std::uint32_t> removedParts;  ///< of each level: loose parts that were removed as a whole
  std::uint32_t cells = 0;                  ///< of each level; 0: not divided
  bool endsInNothing = false;               ///< below the last level, the mesh is left out
  std::uint64_t faceGroups = 0;             ///< of triangles that face alike, in LOD 0
  std::string stopReason;
  std::string passedThrough;  ///< why, if it was
  MeshFindings findings;
  std::uint64_t nodes = 0;  ///< that use it
};

}  // namespace jalousie::bake
