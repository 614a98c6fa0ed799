// Formats bake reports.
#include "bake/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace jalousie::bake {
namespace {

double percentOfDiagonal(const MeshReport& mesh, double length) {
  return mesh.diagonal > 0.0 ? 100.0 * length / mesh.diagonal : 0.0;
}

}  // namespace

std::string reportText(const std::vector<MeshReport>& meshes) {
  std::string text;
  for (const MeshReport& mesh : meshes) {
    if (!mesh.passedThrough.empty()) {
      text += fmt::format("{}: passed through, {}\n", mesh.name, mesh.passedThrough);
      continue;
    }
    text += fmt::format("{}: {} levels, {}\n", mesh.name, mesh.levels.size(), mesh.stopReason);
    if (mesh.cleaned.degenerate + mesh.cleaned.duplicate > 0)
      text += fmt::format("  removed {} degenerate and {} duplicate triangles\n", mesh.cleaned.degenerate,
                          mesh.cleaned.duplicate);
    text += fmt::format("  {:>3} {:>10} {:>10} {:>12} {:>10} {:>10} {:>9}\n", "LOD", "triangles", "vertices",
                        "max error", "% diagonal", "mean %", "coverage");
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) {
      const LevelReport& level = mesh.levels[k];
      text += fmt::format("  {:>3} {:>10} {:>10} {:>12.5g} {:>10.4f} {:>10.5f} {:>9.2g}\n", k, level.triangles,
                          level.vertices, level.errorObject, percentOfDiagonal(mesh, level.errorObject),
                          percentOfDiagonal(mesh, level.errorMean), level.screenCoverage);
    }
  }
  return text;
}

std::string reportJson(const std::vector<MeshReport>& meshes) {
  nlohmann::ordered_json json;
  json["meshes"] = nlohmann::ordered_json::array();
  for (const MeshReport& mesh : meshes) {
    nlohmann::ordered_json entry;
    entry["name"] = mesh.name;
    entry["nodes"] = mesh.nodes;
    entry["diagonal"] = mesh.diagonal;
    entry["stop"] = mesh.stopReason;
    entry["passed_through"] = mesh.passedThrough;
    entry["degenerate"] = mesh.cleaned.degenerate;
    entry["duplicate"] = mesh.cleaned.duplicate;
    entry["levels"] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) {
      const LevelReport& level = mesh.levels[k];
      entry["levels"].push_back({{"lod", k},
                                 {"triangles", level.triangles},
                                 {"vertices", level.vertices},
                                 {"error_object", level.errorObject},
                                 {"error_percent", percentOfDiagonal(mesh, level.errorObject)},
                                 {"mean_object", level.errorMean},
                                 {"screen_coverage", level.screenCoverage}});
    }
    json["meshes"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace jalousie::bake
