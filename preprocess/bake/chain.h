// A chain of levels from one mesh, each made from the one before and measured against the first.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bake/combined_mesh.h"

namespace jalousie::bake {

inline constexpr std::uint32_t kMinLevelTriangles = 4;
inline constexpr std::uint32_t kMaxLevels = 16;

struct ChainOptions {
  std::uint32_t levels = 10;              ///< at most, LOD 0 included
  double ratio = 0.5;                     ///< triangles of a level over those of the one before
  std::optional<std::uint32_t> coarsest;  ///< triangles of the last level; replaces ratio
  std::uint32_t samples = 30000;          ///< points per surface for the measured error
};

struct ChainLevel {
  std::vector<std::uint32_t> indices;  ///< into the combined mesh
  double errorMax = 0.0;               ///< object-space length; the maximum up to this level, so it never falls
  double errorMean = 0.0;
  std::uint32_t triangles() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

struct LevelChain {
  std::vector<ChainLevel> levels;  ///< LOD 0 first; never empty
  std::string stopReason;          ///< why there are not more
};

/// Triangles strictly descend, errors never fall, every level has at least kMinLevelTriangles or is LOD 0.
/// @pre mesh has at least one triangle (checked)
LevelChain makeChain(const CombinedMesh& mesh, const ChainOptions& options);

/// MSFT_screencoverage: for each level the share of the screen's area below which the next one may be shown.
/// A sphere of radius r that is D pixels wide on screen shows an object-space error e as e D / 2r pixels. The next
/// level, with error e', is good enough while that is at most one pixel at 1920x1080: D <= 2r / e'. The sphere then
/// covers pi D^2 / 4 of 1920 * 1080 pixels. The last level's value is 0: it is never left.
std::vector<float> screenCoverage(const LevelChain& chain, double radius);

}  // namespace jalousie::bake
