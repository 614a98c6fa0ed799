// Measures how far a level lies from the original surface, in both directions, with normals and texture coordinates.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bake/mesh/flat_patches.h"
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
  std::uint32_t perTriangle = 0;  ///< of the level: fewer points for levels of few triangles; 0: always `samples`
  double closeEnough = 1.02;      ///< the bound is not closed in on below this multiple of the largest distance found
  /// Object-space length: if a sampled distance is larger, the level is useless and the maximum is not searched for.
  double giveUp = std::numeric_limits<double>::infinity();
};

/// Parts of a level whose distances are wanted one by one.
struct LevelGroups {
  std::uint32_t count = 0;
  std::span<const std::uint32_t> ofTriangle;          ///< group of each triangle of the level
  std::span<const std::uint32_t> ofOriginalTriangle;  ///< group of triangles that it lost as a whole, ~0 for all others
};

/// Measures levels against one original, whose hierarchy and samples are made once.
///
/// Means are taken over points spread evenly by area. The maximum is found by branch and bound. The distance to one
/// triangle is convex, so over a piece of a triangle it is largest at a corner. The least of these largest values, over
/// a few near triangles, bounds the distance of the piece to the whole mesh, and so does the distance to a flat face
/// that it lies over. Pieces whose bound exceeds the largest distance found are split in four, the largest bound first.
/// The result is the bound if it is within 5 % of the largest distance found, else that distance plus 5 %. It is never
/// less than any sampled distance. Bounds below 1e-7 of the diagonal are rounding and are not closed in on; over a flat
/// face, 2.6e-5 of the diagonal are.
class DeviationMeter {
 public:
  explicit DeviationMeter(const WedgeMesh& original, const MeterOptions& options = {});
  /// Replaces MeterOptions::giveUp for what is measured from now on.
  void giveUpAbove(double length) { options_.giveUp = length; }
  /// The result does not depend on the slices.
  /// @param vertexMap  for each vertex of the original the one of the level it became, or ~0; may be empty. It only
  /// starts searches. @param level  its sourceWedge refers to the original, for charts
  Deviation measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap = {}) const;
  /// The same. @param groups  get two-sided distances each; points of the original count where they are nearest to the
  /// group   @param distances  [groups.count], filled. Means are over the points that measure took. Maxima are the
  /// largest distances found, in proportion so that the largest of them is the level's: a group with more than half of
  /// that is found at every vertex, others by points
  Deviation measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap, const LevelGroups& groups,
                    std::vector<Distances>& distances) const;

 private:
  Deviation measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap, const LevelGroups* groups,
                    std::vector<Distances>* distances) const;

  const WedgeMesh& original_;
  MeterOptions options_;
  TriangleBvh bvh_;
  double negligible_;  ///< bound that is not split, object-space length
  FlatPatches patches_;
  std::vector<std::uint32_t> chartOf_;  ///< of each wedge of the original
};

}  // namespace jalousie::bake
