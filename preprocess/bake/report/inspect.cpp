// Counts triangles and vertices, and formats chains as text and JSON.
#include "bake/report/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asset/lod_cell_levels.h"
#include "asset/mesh_occluders.h"
#include "asset/triangle_count.h"
#include "bake/io/level_nodes.h"
#include "bake/report/percent.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

using nlohmann::ordered_json;

std::uint64_t countOf(const tinygltf::Model& model, int accessor) {
  return accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size()
             ? model.accessors[static_cast<std::size_t>(accessor)].count
             : 0;
}

InspectedCells inspectCells(const asset::CellTriangles& primitives) {
  std::vector<std::uint64_t> triangles(asset::cellCount(primitives), 0);
  for (const std::vector<std::uint32_t>& primitive : primitives)
    for (std::size_t cell = 0; cell < primitive.size(); ++cell)
      triangles[cell] += primitive[cell];
  InspectedCells cells;
  cells.count = triangles.size();
  for (const std::uint64_t count : triangles) {
    cells.filled += count > 0 ? 1U : 0U;
    cells.largest = std::max(cells.largest, count);
  }
  return cells;
}

InspectedGroups inspectGroups(const asset::LodCellLevels& levels) {
  InspectedGroups groups;
  groups.count = levels.errors.size();
  std::vector<std::uint64_t> cells(groups.count, 0);
  for (const std::uint32_t group : levels.groupOf)
    groups.mostCells = std::max(groups.mostCells, ++cells[group]);
  if (groups.count > 0) groups.least = groups.largest = levels.errors[0];
  for (const asset::DistanceInfo& error : levels.errors) {
    groups.least = {std::min(groups.least.max, error.max), std::min(groups.least.mean, error.mean)};
    groups.largest = {std::max(groups.largest.max, error.max), std::max(groups.largest.mean, error.mean)};
  }
  return groups;
}

InspectedFaces inspectFaces(const asset::LodFaces& faces) {
  InspectedFaces result;
  result.grouping = faces.grouping;
  for (const asset::FaceTree& tree : faces.trees) {
    for (const std::uint32_t triangles : tree) {
      result.groups += triangles > 0 ? 1U : 0U;
      result.triangles += triangles;
      result.largest = std::max<std::uint64_t>(result.largest, triangles);
    }
  }
  return result;
}

/// "  clusters 812, mean 73, largest 96" behind the figures of a level; empty without groups.
std::string facesText(const InspectedFaces& faces) {
  if (faces.groups == 0) return "";
  return fmt::format("  {} {}, mean {:.0f}, largest {}", asset::nameOf(faces.grouping), faces.groups,
                     static_cast<double>(faces.triangles) / static_cast<double>(faces.groups), faces.largest);
}

InspectedLevel inspectMesh(const tinygltf::Model& model, int index) {
  InspectedLevel level;
  level.mesh = index;
  const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const auto found = primitive.attributes.find("POSITION");
    level.vertices += found == primitive.attributes.end() ? 0 : countOf(model, found->second);
    level.triangles += asset::triangleCount(model, primitive);
  }
  level.info = asset::lodInfo(mesh);
  level.cells = inspectCells(asset::lodCells(model, mesh));
  level.groups = inspectGroups(asset::lodCellLevels(model, mesh));
  level.faces = inspectFaces(asset::lodFaces(model, mesh));
  return level;
}

/// "  115 groups to LOD 1, max 0.0021 to 0.0187 %" behind the figures of a level; empty without groups.
std::string groupsText(const InspectedLevel& level, std::size_t k) {
  if (level.groups.count == 0) return "";
  const double diagonal = level.info->measures->diagonal;
  return fmt::format("  {} groups to LOD {}, max {:.4f} to {:.4f} %", level.groups.count, k + 1,
                     percentOf(diagonal, level.groups.least.max), percentOf(diagonal, level.groups.largest.max));
}

/// A figure of a level as text; '-' if the file does not store it.
template <class Figure>
std::string cell(const InspectedLevel& level, const char* format, const Figure& figure) {
  if (!level.info || !level.info->measures) return "-";
  return fmt::format(fmt::runtime(format), figure(*level.info->measures));
}

/// Whether levels of the chain were made for given errors.
bool hasTargets(const InspectedChain& chain) {
  return std::any_of(chain.levels.begin(), chain.levels.end(), [](const InspectedLevel& level) {
    return level.info && level.info->measures && level.info->measures->target;
  });
}

std::string levelText(const InspectedChain& chain, std::size_t k) {
  const InspectedLevel& level = chain.levels[k];
  const double share = chain.levels[0].triangles > 0 ? 100.0 * static_cast<double>(level.triangles) /
                                                           static_cast<double>(chain.levels[0].triangles)
                                                     : 0.0;
  const auto largest = [&](const asset::LodMeasures& m) { return percentOf(m.diagonal, level.info->errorObject); };
  const auto mean = [](const asset::LodMeasures& m) { return percentOf(m.diagonal, m.twoSided.mean); };
  const auto normal = [](const asset::LodMeasures& m) { return m.normalDegrees.mean; };
  const auto p95 = [](const asset::LodMeasures& m) { return m.normalDegrees.p95; };
  const auto uv = [](const asset::LodMeasures& m) { return m.uv.mean; };
  std::string target;
  if (hasTargets(chain)) target = " " + cell(level, "{}", targetText);
  return fmt::format("  {:>3} {:>10} {:>10} {:>7.2f} {:>9}{} {:>9} {:>8} {:>8} {:>9} {:>9} {:>7} {:>7}{}{}\n", k,
                     level.triangles, level.vertices, share, cell(level, "{:.4f}", largest), target,
                     cell(level, "{:.5f}", mean), cell(level, "{:.2f}°", normal), cell(level, "{:.2f}°", p95),
                     cell(level, "{:.2g}", uv),
                     k < chain.coverage.size() ? fmt::format("{:.2g}", chain.coverage[k]) : "-",
                     level.cells.count > 0 ? fmt::format("{}", level.cells.filled) : "-",
                     level.cells.count > 0 ? fmt::format("{}", level.cells.largest) : "-", groupsText(level, k),
                     facesText(level.faces));
}

ordered_json groupsJson(const InspectedGroups& groups, double diagonal) {
  return {{"groups", groups.count},
          {"most_cells", groups.mostCells},
          {"max_percent", {percentOf(diagonal, groups.least.max), percentOf(diagonal, groups.largest.max)}},
          {"mean_percent", {percentOf(diagonal, groups.least.mean), percentOf(diagonal, groups.largest.mean)}}};
}

ordered_json levelJson(const InspectedChain& chain, std::size_t k) {
  const InspectedLevel& level = chain.levels[k];
  ordered_json json = {{"lod", k}, {"triangles", level.triangles}, {"vertices", level.vertices}};
  if (k < chain.coverage.size()) json["screen_coverage"] = chain.coverage[k];
  if (level.cells.count > 0) {
    json["cells"] = {{"count", level.cells.count},
                     {"filled", level.cells.filled},
                     {"largest", level.cells.largest},
                     {"mean", static_cast<double>(level.triangles) /
                                  static_cast<double>(std::max(level.cells.filled, std::uint64_t{1}))}};
  }
  if (level.faces.groups > 0) {
    json["faces"] = {{"kind", asset::nameOf(level.faces.grouping)},
                     {"groups", level.faces.groups},
                     {"triangles", level.faces.triangles},
                     {"largest", level.faces.largest}};
  }
  if (level.info) json["error_object"] = level.info->errorObject;
  if (!level.info || !level.info->measures) return json;
  const asset::LodMeasures& measures = *level.info->measures;
  if (level.groups.count > 0) json["cell_levels"] = groupsJson(level.groups, measures.diagonal);
  json["error_percent"] = percentOf(measures.diagonal, level.info->errorObject);
  if (measures.target) {
    json["target_object"] = *measures.target;
    json["target_percent"] = percentOf(measures.diagonal, *measures.target);
  }
  json["mean_percent"] = percentOf(measures.diagonal, measures.twoSided.mean);
  json["normal_degrees"] = {{"mean", measures.normalDegrees.mean}, {"p95", measures.normalDegrees.p95}};
  json["uv"] = {{"mean", measures.uv.mean}, {"p95", measures.uv.p95}};
  if (!measures.stop.empty()) json["stop"] = measures.stop;
  return json;
}

/// One line for each occluder.
std::string occludersText(const InspectedChain& chain) {
  std::string text;
  for (const asset::Occluder& occluder : chain.occluders) {
    const glm::vec3 extent = boundsOf(occluder.solid).extent();
    text +=
        fmt::format("  occluder: {} of {} faces, {:.3g} x {:.3g} x {:.3g}, inside {} of {} levels\n",
                    occluder.solid.isPolygon() ? "polygon" : "solid", occluder.solid.faces.size(), extent.x, extent.y,
                    extent.z, std::min<std::size_t>(occluder.levels, chain.levels.size()), chain.levels.size());
  }
  return text;
}

ordered_json occluderJson(const asset::Occluder& occluder) {
  const Aabb box = boundsOf(occluder.solid);
  return {{"vertices", occluder.solid.vertices.size()},
          {"faces", occluder.solid.faces.size()},
          {"levels", occluder.levels},
          {"min", {box.min.x, box.min.y, box.min.z}},
          {"max", {box.max.x, box.max.y, box.max.z}}};
}

/// Portals in the border of each room.
std::vector<std::size_t> portalCounts(const RoomPlan& plan) {
  std::vector<std::size_t> counts(plan.rooms.size());
  for (const Portal& portal : plan.portals)
    for (const std::uint32_t room : portal.rooms)
      ++counts[room];
  return counts;
}

std::size_t outlinePoints(const Room& room) {
  std::size_t points = 0;
  for (const std::vector<glm::dvec2>& loop : room.outline)
    points += loop.size();
  return points;
}

/// A line for all rooms and one for each; empty without rooms.
std::string roomsText(const RoomPlan& plan) {
  if (plan.empty()) return "";
  std::string text = fmt::format("rooms: {}, portals: {}\n", plan.rooms.size(), plan.portals.size());
  const std::vector<std::size_t> portals = portalCounts(plan);
  for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
    const Room& room = plan.rooms[i];
    text += fmt::format("  room {}{}{}: y {:.4g} to {:.4g}, {} points, {} portals\n", i, room.name.empty() ? "" : " ",
                        oneLine(room.name), room.floor, room.ceiling, outlinePoints(room), portals[i]);
  }
  return text;
}

ordered_json roomsJson(const RoomPlan& plan) {
  ordered_json rooms = ordered_json::array();
  const std::vector<std::size_t> portals = portalCounts(plan);
  for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
    const Room& room = plan.rooms[i];
    const auto [low, high] = extentOf(room);
    rooms.push_back({{"name", room.name},
                     {"min", {low.x, room.floor, low.y}},
                     {"max", {high.x, room.ceiling, high.y}},
                     {"points", outlinePoints(room)},
                     {"portals", portals[i]}});
  }
  return rooms;
}

}  // namespace

std::vector<InspectedChain> inspectModel(const tinygltf::Model& model) {
  const std::vector<bool> isLower = levelNodes(model);
  std::vector<InspectedChain> chains(model.meshes.size());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (isLower[n] || node.mesh < 0) continue;
    InspectedChain& chain = chains[static_cast<std::size_t>(node.mesh)];
    if (chain.nodes++ > 0) continue;
    const std::string& name = model.meshes[static_cast<std::size_t>(node.mesh)].name;
    chain.name = name.empty() ? fmt::format("mesh {}", node.mesh) : name;
    chain.levels.push_back(inspectMesh(model, node.mesh));
    for (const int lower : asset::lodNodes(model, static_cast<int>(n)))
      chain.levels.push_back(inspectMesh(model, model.nodes[static_cast<std::size_t>(lower)].mesh));
    chain.coverage = asset::lodCoverage(node);
    chain.endsInNothing = asset::emptyLevel(model, static_cast<int>(n)) >= 0;
    chain.occluders = asset::meshOccluders(model.meshes[static_cast<std::size_t>(node.mesh)]);
  }
  std::erase_if(chains, [](const InspectedChain& chain) { return chain.nodes == 0; });
  return chains;
}

std::string inspectText(const std::vector<InspectedChain>& chains, const RoomPlan& rooms) {
  std::string text;
  for (const InspectedChain& chain : chains) {
    text += fmt::format("{}: {} level{}, {} node{}\n", oneLine(chain.name), chain.levels.size(),
                        chain.levels.size() == 1 ? "" : "s", chain.nodes, chain.nodes == 1 ? "" : "s");
    text += fmt::format("  {:>3} {:>10} {:>10} {:>7} {:>9}{} {:>9} {:>8} {:>8} {:>9} {:>9} {:>7} {:>7}\n", "LOD",
                        "triangles", "vertices", "%", "max %", hasTargets(chain) ? "  target %" : "", "mean %",
                        "normal", "p95", "uv", "coverage", "cells", "largest");
    for (std::size_t k = 0; k < chain.levels.size(); ++k)
      text += levelText(chain, k);
    const auto& last = chain.levels.back().info;
    text += occludersText(chain);
    if (last && last->measures && !last->measures->stop.empty()) text += "  " + last->measures->stop + "\n";
  }
  if (text.empty()) text = "no mesh is in use\n";
  return text + roomsText(rooms);
}

std::string inspectJson(const std::vector<InspectedChain>& chains, const RoomPlan& rooms) {
  ordered_json json;
  json["chains"] = ordered_json::array();
  for (const InspectedChain& chain : chains) {
    ordered_json entry = {{"name", chain.name}, {"nodes", chain.nodes}, {"ends_in_nothing", chain.endsInNothing}};
    for (const asset::Occluder& occluder : chain.occluders)
      entry["occluders"].push_back(occluderJson(occluder));
    entry["levels"] = ordered_json::array();
    for (std::size_t k = 0; k < chain.levels.size(); ++k)
      entry["levels"].push_back(levelJson(chain, k));
    json["chains"].push_back(std::move(entry));
  }
  if (!rooms.empty()) {
    json["rooms"] = roomsJson(rooms);
    json["portals"] = rooms.portals.size();
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace jalousie::bake
