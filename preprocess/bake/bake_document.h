// Gives every mesh of a document its LOD chain.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "asset/lod_chain.h"
#include "bake/chain.h"
#include "bake/clean.h"

namespace jalousie::bake {

struct BakeOptions {
  ChainOptions chain;
  std::uint32_t subdivide = 0;      ///< Loop steps before anything else
  std::optional<double> hardAngle;  ///< rebuild normals: edges that bend by more degrees stay hard
  ScreenTolerance screen;           ///< for MSFT_screencoverage
  asset::Limits limits;
};

/// What was found in a mesh before it was simplified.
struct MeshFindings {
  CleanCounts cleaned;
  std::uint64_t repairedValues = 0;     ///< NaN or infinite numbers in attributes, now 0
  std::uint64_t notFinitePassedOn = 0;  ///< vertices with NaN or infinite positions in a mesh that is passed through
  std::uint64_t nonManifoldEdges = 0;   ///< of three and more triangles, or of two that run the same way; passed on
  std::uint64_t openEdges = 0;
  std::uint64_t looseParts = 0;
};

struct MeshReport {
  std::string name;
  double diagonal = 0.0;               ///< of LOD 0's box
  std::vector<asset::LodInfo> levels;  ///< as written, with measures; empty if the mesh was passed through
  std::string stopReason;
  std::string passedThrough;  ///< why, if it was
  MeshFindings findings;
  std::uint64_t nodes = 0;  ///< that use it
};

/// Bakes every mesh that a node uses, once; nodes that share a mesh share its levels. Lower levels are nodes in no
/// scene with the same transform (and instances). Everything else in the document stays as it is.
/// @param progress  meshes done, of how many, and what the current one is at. Errors: kMalformed, kUnsupported, kLimit,
/// each naming the mesh.
std::vector<MeshReport> bakeDocument(tinygltf::Model& model, const BakeOptions& options,
                                     const std::function<void(std::size_t, std::size_t, const std::string&)>& progress);

}  // namespace jalousie::bake
