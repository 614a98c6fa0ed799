// Occluders of a mesh: convex solids and polygons in its extras (docs/formats.md).
//
// On a mesh:  extras.jalousie_occluders = [{"vertices": [[x, y, z], ...], "faces": [[i, j, k, ...], ...],
//                                           "levels": n, "bothSides": b}, ...]
#pragma once

#include <tiny_gltf.h>

#include <span>
#include <vector>

#include "asset/scene_types.h"

namespace jalousie::asset {

inline constexpr const char* kOccluders = "jalousie_occluders";
inline constexpr std::size_t kMostOccluders = 256;  ///< of a mesh

/// Writes them, keeping other extras; none: removes what was there.
void setOccluders(tinygltf::Mesh& mesh, std::span<const Occluder> occluders);
/// Reads them back; empty if absent. Errors: kMalformed (wrong types, too many, faultOf).
std::vector<Occluder> meshOccluders(const tinygltf::Mesh& mesh);
/// Errors: kMalformed where a vertex lies outside of a mesh by more than a ten-thousandth of its diagonal.
/// @param meshBounds  of all positions of the mesh
void requireWithin(std::span<const Occluder> occluders, const Aabb& meshBounds);

}  // namespace jalousie::asset
