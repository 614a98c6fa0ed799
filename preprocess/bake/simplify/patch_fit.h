// Fits a control mesh so that its Phong-tessellated surface approximates an original (least squares).
#pragma once

#include <cstdint>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/deviation.h"
#include "bake/simplify/measure.h"
#include "bake/simplify/patch_surface.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

struct PatchFitOptions {
  std::uint32_t rounds = 12;      ///< at most; each one solves for positions, normals and alpha
  std::uint32_t samples = 30000;  ///< points of the original
  std::uint32_t level = 6;        ///< tessellation level at which points are projected
  SliceRunner slices = runInOneSlice;
};

struct PatchFit {
  PatchMesh mesh;
  double before = 0.0;  ///< root of the mean squared two-sided distance at PatchFitOptions::level, object-space length
  double after = 0.0;   ///< the same of the fitted mesh; never larger
  std::uint32_t rounds = 0;
};

/// Least squares over points of the original, projected onto the tessellated surface, and over points of that surface,
/// projected onto the original. The surface is linear in the positions and quadratic in the normals. A round solves for
/// the positions (damped, conjugate gradients), then for the normals (one Gauss-Newton step), then for alpha (closed
/// form). A step counts if it makes the distance smaller once all points are projected again; else a half and a quarter
/// of it are tried. The fit ends with a round without progress. The triangles stay, so closed meshes stay closed.
/// Points whose normals disagree with the surface where they land do not count.
/// @param start  its positions, normals, alpha and triangles   @pre neither mesh is empty (checked)
/// @return  the same for any slices
PatchFit fitPatches(const WedgeMesh& original, const PatchMesh& start, const PatchFitOptions& options = {});

/// Deviation of the surface at a tessellation level. @param meter  of the original
Deviation measurePatches(const DeviationMeter& meter, const PatchMesh& mesh, std::uint32_t level);

}  // namespace jalousie::bake
