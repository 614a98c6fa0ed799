// The baked format: a discrete LOD chain as MSFT_lod, with what the baker measured in `extras`.
//
// On the LOD 0 node:   extensions.MSFT_lod.ids = [node of LOD 1, node of LOD 2, ...]     (these nodes are in no scene)
//                      extras.MSFT_screencoverage = [c0, c1, ...]                        one per level, descending
// On each level's mesh: extras.jalousie = {"format": 1, "lod": k, "triangles": t, "vertices": v, "errorObject": e}
//
// Version history
//   1  first
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace jalousie::asset {

inline constexpr int kLodFormatVersion = 1;

/// What the baker knows of one level.
struct LodInfo {
  std::uint32_t lod = 0;        ///< 0 is the finest
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
  double errorObject = 0.0;     ///< deviation from LOD 0, object-space length, ascending along the chain
};

/// Writes extras.jalousie of a level's mesh, keeping other extras.
void setLodInfo(tinygltf::Mesh& mesh, const LodInfo& info);
/// Reads it back; nullopt if absent. Errors: kMalformed (wrong types, negative, unknown format version).
std::optional<LodInfo> lodInfo(const tinygltf::Mesh& mesh);

/// Makes node the LOD 0 of a chain. @param lowerNodes  nodes of LOD 1, 2, ...  @param coverage  one per level, LOD 0 first:
/// the share of the screen's area below which the next level may be shown (MSFT_screencoverage).
/// Declares MSFT_lod in model.extensionsUsed.
void setLodChain(tinygltf::Model& model, int node, std::span<const int> lowerNodes, std::span<const float> coverage);
/// Node indices of LOD 1, 2, ...; empty without MSFT_lod. Errors: kMalformed (index out of range, a node twice or itself,
/// a node without a mesh).
std::vector<int> lodNodes(const tinygltf::Model& model, int node);
/// extras.MSFT_screencoverage; empty if absent.
std::vector<float> lodCoverage(const tinygltf::Node& node);

}  // namespace jalousie::asset
