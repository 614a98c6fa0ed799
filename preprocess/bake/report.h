// The report of a bake, for people and as JSON.
#pragma once

#include <string>
#include <vector>

#include "bake/bake_document.h"

namespace jalousie::bake {

/// One table per mesh.
std::string reportText(const std::vector<MeshReport>& meshes);
/// {"meshes": [{"name", "nodes", "diagonal", "stop", "passed_through", "degenerate", "duplicate",
///   "levels": [{"lod", "triangles", "vertices", "error_object", "error_percent", "mean_object", "screen_coverage"}]}]}
std::string reportJson(const std::vector<MeshReport>& meshes);

}  // namespace jalousie::bake
