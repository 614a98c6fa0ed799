// Options of a chain of levels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bake/simplify/collapse_options.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

inline constexpr std::uint32_t kMaxLevels = 16;

enum class Preset : std::uint8_t {
  kBest,   ///< collapse on position and attributes, two rounds of refit
  kFast,   ///< collapse without weighting normals, one round of refit on fewer samples
  kDraft,  ///< meshoptimizer, no refit
};

struct ChainOptions {
  Preset preset = Preset::kBest;
  std::uint32_t levels = 10;                    ///< at most, LOD 0 included
  double ratio = 0.5;                           ///< triangles of a level over those of the one before
  std::vector<double> ratios;                   ///< triangles of LOD 1, 2, ... over those of LOD 0; replaces ratio
  std::vector<std::uint32_t> targets;           ///< triangles of LOD 1, 2, ..., descending; replaces ratios
  bool isShare = false;                         ///< the targets are a share of a scene's
  bool leftOut = false;                         ///< below the last level, the mesh is not shown
  std::optional<std::uint32_t> coarsest;        ///< triangles of the last level; replaces ratio
  std::vector<double> errors;                   ///< of LOD 1, 2, ..., % of the diagonal, ascending; replaces the above
  double errorReserve = 0.0;                    ///< object-space length by which levels stay below these errors
  double untilError = 25.0;                     ///< no level with a larger maximum, % of the diagonal; not with errors
  std::optional<double> reference;              ///< object-space length that replaces the diagonal of these errors
  std::optional<std::uint32_t> untilTriangles;  ///< no level with fewer triangles
  std::uint32_t cellTriangles = 0;              ///< most triangles of a cell with a level of its own; 0: none
  CollapseOptions collapse;
  std::optional<std::uint32_t> samples;  ///< points per surface for the measures; the preset decides otherwise
  SliceRunner slices = runInOneSlice;    ///< runs the loops of refit and measurement
};

/// The screen-space error that is allowed when a level is replaced by the next one.
struct ScreenTolerance {
  double pixels = 1.0;     ///< largest error on screen
  double height = 1080.0;  ///< of the 16:9 screen, pixels
};

}  // namespace jalousie::bake
