// A chain of levels from one mesh, each made from the one before and measured against the first.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/collapse.h"
#include "bake/measure.h"
#include "bake/wedge_mesh.h"

namespace jalousie::bake {

inline constexpr std::uint32_t kMinLevelTriangles = 4;
inline constexpr std::uint32_t kMaxLevels = 16;

enum class Preset : std::uint8_t {
  kBest,   ///< collapse on position and attributes, two rounds of refit
  kFast,   ///< collapse on position, one round of refit on fewer samples
  kDraft,  ///< meshoptimizer, no refit
};

struct ChainOptions {
  Preset preset = Preset::kBest;
  std::uint32_t levels = 10;                    ///< at most, LOD 0 included
  double ratio = 0.5;                           ///< triangles of a level over those of the one before
  std::vector<double> ratios;                   ///< triangles of LOD 1, 2, ... over those of LOD 0; replaces ratio
  std::optional<std::uint32_t> coarsest;        ///< triangles of the last level; replaces ratio
  double untilError = 25.0;                     ///< no level with a larger maximum, % of the diagonal
  std::optional<std::uint32_t> untilTriangles;  ///< no level with fewer triangles
  CollapseOptions collapse;
  std::optional<std::uint32_t> samples;  ///< points per surface for the measures; the preset decides otherwise
};

struct ChainLevel {
  WedgeMesh mesh;
  Deviation deviation;
  double errorMax = 0.0;  ///< object-space length: the two-sided maximum up to this level, so it never falls
};

struct LevelChain {
  std::vector<ChainLevel> levels;  ///< LOD 0 first; never empty
  std::string stopReason;          ///< why there are not more
};

/// Triangles strictly descend, errors never fall, every level has at least kMinLevelTriangles or is LOD 0.
/// @param progress  called with the triangles of each level once it is done; may be empty
/// @pre mesh has at least one triangle (checked)
LevelChain makeChain(const WedgeMesh& mesh, const ChainOptions& options,
                     const std::function<void(std::uint32_t)>& progress = {});

/// On which screen an error may be how large before the next level no longer does.
struct ScreenTolerance {
  double pixels = 1.0;     ///< largest error on screen
  double height = 1080.0;  ///< of the screen in pixels; it is 16:9
};

/// MSFT_screencoverage: for each level the share of the screen's area below which the next one may be shown.
/// A sphere of radius r that is D pixels wide on screen shows an object-space error e as e D / 2r pixels. The next
/// level, with error e', is good enough while that is at most `pixels`: D <= 2r pixels / e'. The sphere then covers
/// pi D^2 / 4 of the screen's pixels. The last level's value is 0: it is never left.
std::vector<float> screenCoverage(const LevelChain& chain, double radius, const ScreenTolerance& tolerance = {});

}  // namespace jalousie::bake
