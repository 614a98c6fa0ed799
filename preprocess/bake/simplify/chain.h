// Makes a chain of levels from one mesh: each level is made from the one before and measured against the first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/chain_level.h"
#include "bake/simplify/chain_options.h"
#include "bake/simplify/collapse.h"

namespace jalousie::bake {

struct LevelChain {
  std::vector<ChainLevel> levels;  ///< LOD 0 first; never empty
  std::string stopReason;          ///< why there are no more levels
  bool endsInNothing = false;      ///< see ChainOptions::leftOut
};

/// Triangles strictly descend, errors never fall, every level has at least kMinLevelTriangles or is LOD 0.
/// With ChainOptions::errors, no level's errorMax exceeds its target.
/// @param progress  called once a level is done; may be empty
/// @pre mesh has at least one triangle (checked)
LevelChain makeChain(const WedgeMesh& mesh, const ChainOptions& options, const LevelProgress& progress = {});

/// Wanted triangles of level k of a mesh or scene with this many; 0 if the options ask for no such level.
std::uint32_t targetOf(const ChainOptions& options, std::uint32_t finest, std::size_t k);

/// What the collapse of a mesh costs.
struct CostCurve {
  std::vector<CostPoint> points;  ///< as EdgeCollapser::costs: squared distances times areas, but in object space
  std::uint32_t unseen = 0;       ///< triangles after all collapses of at most a thousandth of the diagonal, on average
  double removal = 0.0;           ///< of the whole mesh, for each two triangles that are left of it; unit of the points
};
/// Runs the collapse of a chain to its end. @pre the preset is not kDraft (checked)
CostCurve costCurve(const WedgeMesh& mesh, const ChainOptions& options);

/// MSFT_screencoverage: for each level the share of the screen's area below which the next level may be shown.
/// A sphere of radius r that is D pixels wide on screen shows an object-space error e as e D / 2r pixels. The next
/// level, with error e', is good enough while that is at most `pixels`: D <= 2r pixels / e'. The sphere then covers
/// pi D^2 / 4 of the screen's pixels. The last level's value is 0: there is no next level.
/// If the mesh is left out below it, e' is the sphere's diameter.
std::vector<float> screenCoverage(const LevelChain& chain, double radius, const ScreenTolerance& tolerance = {});

}  // namespace jalousie::bake
