// One level of a chain.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/deviation.h"

namespace jalousie::bake {

struct ChainLevel {
  WedgeMesh mesh;
  Deviation deviation;
  double errorMax = 0.0;           ///< object-space length: the two-sided maximum up to this level, so it never falls
  std::uint32_t removedParts = 0;  ///< loose parts of the mesh that the level is without, if they were removed whole
  std::optional<double> target;    ///< object-space length: the error that was asked for
};

/// A level that is done.
struct LevelDone {
  std::size_t level = 0;   ///< LOD 0 counts as 0
  std::size_t wanted = 0;  ///< levels that the options ask for, LOD 0 included
  std::uint32_t triangles = 0;
};
using LevelProgress = std::function<void(const LevelDone&)>;

}  // namespace jalousie::bake
