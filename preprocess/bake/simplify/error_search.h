// Finds the level of fewest triangles whose measured error does not exceed a length.
#pragma once

#include <memory>
#include <optional>

#include "bake/simplify/chain_level.h"
#include "bake/simplify/level_maker.h"
#include "bake/simplify/measure.h"

namespace jalousie::bake {

/// Searches one level after the other, with ascending limits. Each attempt collapses a copy of the last level that kept
/// its limit, fits and measures it. Attempts halve the triangles until one exceeds the limit; then they follow the
/// error as a power of the number of triangles, and close in from both sides. A limit is
/// reached if the error is within 2 % of it, or if 1 % fewer triangles exceed it. Loose parts whose absence would
/// exceed the limit stay.
class ErrorSearch {
 public:
  /// Keeps a reference to the mesh, the meter and the options.
  ErrorSearch(const WedgeMesh& mesh, const ChainOptions& options, DeviationMeter& meter);

  /// @param last  the level before   @param limit  object-space length
  /// @return  nullopt if the last level or every level of fewer triangles that was tried exceeds the limit
  std::optional<ChainLevel> next(const ChainLevel& last, double limit);

 private:
  bool keepLostParts(const LevelMaker& maker, const LevelMaker::Level& level, double limit);
  LevelMaker::Level make(std::unique_ptr<LevelMaker>& maker, std::uint32_t triangles, double limit);

  const WedgeMesh& mesh_;
  std::unique_ptr<LevelMaker> maker_;  ///< at the last level
  std::vector<std::uint8_t> keep_;     ///< loose parts that stay within the limit
  DeviationMeter& meter_;
};

/// Fits a level and measures it. It gets neither deviation nor error if it has fewer than kMinLevelTriangles.
/// @param made  what the maker made last   @param last  the level before
ChainLevel measuredLevel(const LevelMaker& maker, const DeviationMeter& meter, LevelMaker::Level made,
                         const ChainLevel& last);

}  // namespace jalousie::bake
