// The report of a bake as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "bake/io/mesh_report.h"
#include "bake/io/notes.h"

namespace jalousie::bake {

/// One table per mesh: errors in object units and % of the diagonal, normals in degrees, UV in texture space.
std::string reportText(const std::vector<MeshReport>& meshes);
/// {"warnings": [text],
/// "meshes": [{"name", "nodes", "diagonal", "stop", "passed_through", "not_finite", "not_finite_passed_on",
/// "degenerate", "bridges", "duplicate",
///   "repaired_values", "non_manifold_edges", "open_edges", "snapped", "nearly_welded",
///   "loose_parts", "unused_attributes": [name],
///   "levels": [{"lod", "triangles", "vertices", "error_object", "error_percent", ("target_object",
///     "target_percent",) "two_sided": D, "to_original": D,
///     "from_original": D, "normal_degrees": S, "uv": S, "screen_coverage",
///     "removed_parts"}]}]}
/// with D = {"max", "mean", "max_percent", "mean_percent"} and S = {"mean", "p95"}
std::string reportJson(const std::vector<MeshReport>& meshes, const std::vector<std::string>& warnings = {});
/// The warnings of a report that reportJson made.
std::vector<std::string> reportedWarnings(const std::string& json);

/// Notes the meshes that were passed through or repaired.
void noteMeshes(const std::vector<MeshReport>& meshes, Notes& notes);

}  // namespace jalousie::bake
