// Formats bake reports as text and JSON.
#include "bake/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bake/report/percent.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

using nlohmann::ordered_json;

std::string findingsText(const MeshFindings& findings) {
  std::string text;
  const auto note = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("  {} {}\n", count, what);
  };
  note(findings.cleaned.notFinite, "triangles with NaN or infinite positions dropped");
  note(findings.cleaned.degenerate, "triangles without area dropped");
  note(findings.cleaned.bridges, "triangles without area kept, because they join others");
  note(findings.cleaned.duplicate, "duplicate triangles dropped");
  note(findings.repairedValues, "NaN or infinite attribute values set to 0");
  for (const std::string& name : findings.unusedAttributes)
    text += fmt::format("  {} left out of the coarser levels: no material uses it (--keep-unused keeps it)\n",
                        oneLine(name));
  note(findings.cleaned.snapped, "vertices welded to others nearby");
  if (findings.nearlyWelded > 0)
    text += fmt::format("  {} vertices of open edges are within {:.1g} of others; --weld {:.1g} joins them\n",
                        findings.nearlyWelded, findings.weldHint, findings.weldHint);
  note(findings.nonManifoldEdges, "non-manifold edges kept as they are");
  return text;
}

std::string levelsText(const MeshReport& mesh) {
  const bool hasTargets = std::any_of(mesh.levels.begin(), mesh.levels.end(),
                                      [](const asset::LodInfo& level) { return level.measures->target.has_value(); });
  std::string text = fmt::format("  {:>3} {:>10} {:>10} {:>11} {:>9}{} {:>9} {:>8} {:>8} {:>9} {:>9}\n", "LOD",
                                 "triangles", "vertices", "max error", "max %", hasTargets ? "  target %" : "",
                                 "mean %", "normal", "p95", "uv", "coverage");
  for (const asset::LodInfo& level : mesh.levels) {
    const asset::LodMeasures& measures = *level.measures;
    const std::string target = hasTargets ? " " + targetText(measures) : "";
    text += fmt::format("  {:>3} {:>10} {:>10} {:>11.5g} {:>9.4f}{} {:>9.5f} {:>7.2f}° {:>7.2f}° {:>9.2g} {:>9.2g}\n",
                        level.lod, level.triangles, level.vertices, level.errorObject,
                        percentOf(mesh.diagonal, level.errorObject), target,
                        percentOf(mesh.diagonal, measures.twoSided.mean), measures.normalDegrees.mean,
                        measures.normalDegrees.p95, measures.uv.mean, measures.coverage);
  }
  return text;
}

ordered_json distanceJson(const asset::DistanceInfo& distance, double diagonal) {
  return {{"max", distance.max},
          {"mean", distance.mean},
          {"max_percent", percentOf(diagonal, distance.max)},
          {"mean_percent", percentOf(diagonal, distance.mean)}};
}

ordered_json levelJson(const asset::LodInfo& level, double diagonal) {
  const asset::LodMeasures& measures = *level.measures;
  ordered_json json = {{"lod", level.lod},
                       {"triangles", level.triangles},
                       {"vertices", level.vertices},
                       {"error_object", level.errorObject},
                       {"error_percent", percentOf(diagonal, level.errorObject)}};
  if (measures.target) {
    json["target_object"] = *measures.target;
    json["target_percent"] = percentOf(diagonal, *measures.target);
  }
  json["two_sided"] = distanceJson(measures.twoSided, diagonal);
  json["to_original"] = distanceJson(measures.toOriginal, diagonal);
  json["from_original"] = distanceJson(measures.fromOriginal, diagonal);
  json["normal_degrees"] = {{"mean", measures.normalDegrees.mean}, {"p95", measures.normalDegrees.p95}};
  json["uv"] = {{"mean", measures.uv.mean}, {"p95", measures.uv.p95}};
  json["screen_coverage"] = measures.coverage;
  return json;
}

}  // namespace

std::string reportText(const std::vector<MeshReport>& meshes) {
  std::string text;
  for (const MeshReport& mesh : meshes) {
    if (!mesh.passedThrough.empty()) {
      text +=
          fmt::format("{}: passed through, {}\n", oneLine(mesh.name), mesh.passedThrough) + findingsText(mesh.findings);
      continue;
    }
    const std::string cells = mesh.cells > 0 ? fmt::format(" of {} cells", mesh.cells) : "";
    const std::string groups = mesh.faceGroups > 0 ? fmt::format(", {} groups in LOD 0", mesh.faceGroups) : "";
    text +=
        fmt::format("{}: {} levels{}{}, {}\n", oneLine(mesh.name), mesh.levels.size(), cells, groups, mesh.stopReason);
    text += findingsText(mesh.findings);
    if (!mesh.removedParts.empty() && mesh.removedParts.back() > 0)
      text += fmt::format("  {} of {} loose parts are left out of the last level\n", mesh.removedParts.back(),
                          mesh.findings.looseParts);
    text += levelsText(mesh);
  }
  return text;
}

std::vector<std::string> reportedWarnings(const std::string& json) {
  return ordered_json::parse(json).value("warnings", std::vector<std::string>());
}

void noteMeshes(const std::vector<MeshReport>& meshes, Notes& notes) {
  for (const MeshReport& mesh : meshes) {
    if (!mesh.passedThrough.empty()) notes.add("a mesh is passed through because " + mesh.passedThrough, mesh.name);
    if (mesh.findings.cleaned.notFinite > 0)
      notes.add("triangles with NaN or infinite positions are dropped", mesh.name);
    if (mesh.findings.repairedValues > 0) notes.add("NaN or infinite attribute values are set to 0", mesh.name);
    if (mesh.findings.cleaned.degenerate > 0) notes.add("triangles without area are dropped", mesh.name);
    if (mesh.findings.cleaned.duplicate > 0) notes.add("duplicate triangles are dropped", mesh.name);
    if (mesh.endsInNothing)
      notes.add("a small mesh has a last level that shows nothing (--budget mesh keeps it)", mesh.name);
    if (mesh.findings.nearlyWelded > 0)
      notes.add(
          fmt::format("vertices of open edges lie close to others; --weld {:.1g} joins them", mesh.findings.weldHint),
          mesh.name);
    for (const std::string& name : mesh.findings.unusedAttributes)
      notes.add("coarser levels are without an attribute that no material uses (--keep-unused keeps it)",
                fmt::format("{} of {}", oneLine(name), mesh.name));
  }
}

std::string reportJson(const std::vector<MeshReport>& meshes, const std::vector<std::string>& warnings) {
  ordered_json json;
  json["warnings"] = warnings;
  json["meshes"] = ordered_json::array();
  for (const MeshReport& mesh : meshes) {
    ordered_json entry;
    entry["name"] = mesh.name;
    entry["nodes"] = mesh.nodes;
    entry["diagonal"] = mesh.diagonal;
    entry["cells"] = mesh.cells;
    entry["face_groups"] = mesh.faceGroups;
    entry["stop"] = mesh.stopReason;
    entry["ends_in_nothing"] = mesh.endsInNothing;
    entry["passed_through"] = mesh.passedThrough;
    entry["not_finite"] = mesh.findings.cleaned.notFinite;
    entry["degenerate"] = mesh.findings.cleaned.degenerate;
    entry["bridges"] = mesh.findings.cleaned.bridges;
    entry["duplicate"] = mesh.findings.cleaned.duplicate;
    entry["repaired_values"] = mesh.findings.repairedValues;
    entry["non_manifold_edges"] = mesh.findings.nonManifoldEdges;
    entry["open_edges"] = mesh.findings.openEdges;
    entry["snapped"] = mesh.findings.cleaned.snapped;
    entry["nearly_welded"] = mesh.findings.nearlyWelded;
    entry["loose_parts"] = mesh.findings.looseParts;
    entry["unused_attributes"] = mesh.findings.unusedAttributes;
    entry["levels"] = ordered_json::array();
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) {
      entry["levels"].push_back(levelJson(mesh.levels[k], mesh.diagonal));
      entry["levels"].back()["removed_parts"] = k < mesh.removedParts.size() ? mesh.removedParts[k] : 0;
    }
    json["meshes"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace jalousie::bake
