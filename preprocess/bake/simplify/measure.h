// How far a level lies from the original surface, measured both ways, with its shading and texture coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/mesh/surface_samples.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/deviation.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

struct MeterOptions {
  std::uint32_t samples = 100000;   ///< points per surface for means and percentiles
  std::uint32_t searches = 200000;  ///< most pieces looked at while the maximum is closed in on, per direction
  SliceRunner slices = runInOneSlice;
};

/// Measures levels against one original, whose hierarchy and samples are made once.
///
/// Means are taken over points spread evenly by area. A maximum is closed in on by bounds: the distance to one triangle
/// is convex, so over a piece it is largest at a corner, and the least over a few near triangles of that largest value
/// bounds the distance to the whole mesh. Pieces whose bound exceeds what was found are split in four, worst first. The
/// result is the bound once that is within 5 %, else what was found plus 5 %: never less than any sampled distance.
class DeviationMeter {
 public:
  explicit DeviationMeter(const WedgeMesh& original, const MeterOptions& options = {});
  /// Uses all cores; the result does not depend on how many there are.
  /// @param vertexMap  for each vertex of the original the one of the level it became, or ~0; may be empty. It only
  /// starts searches. @param level  its sourceWedge refers to the original, for charts
  Deviation measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap = {}) const;

 private:
  const WedgeMesh& original_;
  MeterOptions options_;
  TriangleBvh bvh_;
  std::vector<SurfaceSample> samples_;
  std::vector<std::uint32_t> chartOf_;  ///< of each wedge of the original
};

}  // namespace jalousie::bake
