// MSFT_lod and the extras of the baked format, as tinygltf values.
#include "asset/lod_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asset/accessor_layout.h"
#include "asset/extras.h"
#include "asset/triangle_count.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kLevels = "MSFT_lod";
constexpr const char* kCoverage = "MSFT_screencoverage";
constexpr const char* kExtras = "jalousie";
constexpr const char* kCells = "cells";
constexpr const char* kCellTriangles = "triangles";
/// A mean of equal distances may be larger than their maximum by its rounding.
constexpr double kMeanRounding = 1e-6;

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

tinygltf::Value distanceValue(const DistanceInfo& distance, double diagonal) {
  const double percent = diagonal > 0.0 ? 100.0 / diagonal : 0.0;
  return tinygltf::Value(tinygltf::Value::Object{{"max", tinygltf::Value(distance.max)},
                                                 {"mean", tinygltf::Value(distance.mean)},
                                                 {"maxPercent", tinygltf::Value(distance.max * percent)},
                                                 {"meanPercent", tinygltf::Value(distance.mean * percent)}});
}

tinygltf::Value spreadValue(const SpreadInfo& spread) {
  return tinygltf::Value(
      tinygltf::Value::Object{{"mean", tinygltf::Value(spread.mean)}, {"p95", tinygltf::Value(spread.p95)}});
}

double memberNumber(const tinygltf::Value& object, const char* key) {
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsNumber()) malformed(fmt::format("extras.{}.{} is not a number", kExtras, key));
  const double number = value.GetNumberAsDouble();
  if (number < 0.0) malformed(fmt::format("extras.{}.{} is negative", kExtras, key));
  if (!std::isfinite(static_cast<float>(number)))
    malformed(fmt::format("extras.{}.{} is no finite float", kExtras, key));
  return number;
}

std::uint32_t memberCount(const tinygltf::Value& object, const char* key) {
  const double number = memberNumber(object, key);
  if (number != std::floor(number) || number > static_cast<double>(std::numeric_limits<int>::max()))
    malformed(fmt::format("extras.{}.{} is not a count", kExtras, key));
  return static_cast<std::uint32_t>(number);
}

std::uint32_t memberFormat(const tinygltf::Value& object) {
  const std::uint32_t format = memberCount(object, "format");
  if (format < 1 || format > static_cast<std::uint32_t>(kLodFormatVersion))
    malformed(fmt::format("extras.jalousie.format is {}, known are 1 to {}", format, kLodFormatVersion));
  return format;
}

const tinygltf::Value& memberObject(const tinygltf::Value& object, const char* key) {
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsObject()) malformed(fmt::format("extras.{}.{} is not an object", kExtras, key));
  return value;
}

DistanceInfo memberDistance(const tinygltf::Value& object, const char* key) {
  const tinygltf::Value& value = memberObject(object, key);
  const DistanceInfo distance{memberNumber(value, "max"), memberNumber(value, "mean")};
  if (distance.mean > distance.max * (1.0 + kMeanRounding))
    malformed(fmt::format("extras.{}.{}: the mean is larger than the maximum", kExtras, key));
  return distance;
}

SpreadInfo memberSpread(const tinygltf::Value& object, const char* key) {
  const tinygltf::Value& value = memberObject(object, key);
  return {memberNumber(value, "mean"), memberNumber(value, "p95")};
}

void putMeasures(tinygltf::Value::Object& object, const LodMeasures& measures) {
  object["diagonal"] = tinygltf::Value(measures.diagonal);
  object["toOriginal"] = distanceValue(measures.toOriginal, measures.diagonal);
  object["fromOriginal"] = distanceValue(measures.fromOriginal, measures.diagonal);
  object["twoSided"] = distanceValue(measures.twoSided, measures.diagonal);
  object["normalDegrees"] = spreadValue(measures.normalDegrees);
  object["uv"] = spreadValue(measures.uv);
  object["coverage"] = tinygltf::Value(measures.coverage);
  if (measures.target) object["target"] = tinygltf::Value(*measures.target);
  if (!measures.stop.empty()) object["stop"] = tinygltf::Value(measures.stop);
}

LodMeasures readMeasures(const tinygltf::Value& object, std::uint32_t format) {
  LodMeasures measures;
  measures.diagonal = memberNumber(object, "diagonal");
  measures.toOriginal = memberDistance(object, "toOriginal");
  measures.fromOriginal = memberDistance(object, "fromOriginal");
  measures.twoSided = memberDistance(object, "twoSided");
  measures.normalDegrees = memberSpread(object, "normalDegrees");
  measures.uv = memberSpread(object, "uv");
  measures.coverage = memberNumber(object, "coverage");
  if (format >= 4 && object.Has("target")) measures.target = memberNumber(object, "target");
  if (object.Has("stop")) {
    if (!object.Get("stop").IsString()) malformed("extras.jalousie.stop is not a string");
    measures.stop = object.Get("stop").Get<std::string>();
  }
  return measures;
}

/// The triangles of each cell of one primitive, which has `triangles` in all.
std::vector<std::uint32_t> readCells(const tinygltf::Value& list, std::size_t primitive, std::uint64_t triangles) {
  const auto wrong = [&](const std::string& what) {
    malformed(fmt::format("extras.jalousie.cells: primitive {} {}", primitive, what));
  };
  if (!list.IsArray()) wrong("has no list");
  std::vector<std::uint32_t> cells;
  cells.reserve(list.ArrayLen());
  std::uint64_t sum = 0;  // of at most 2^31 each: cannot wrap
  for (const tinygltf::Value& value : list.Get<tinygltf::Value::Array>()) {
    const std::optional<std::uint32_t> number = countIn(value);
    if (!number) wrong(fmt::format("has no count of triangles for cell {}", cells.size()));
    cells.push_back(*number);
    sum += cells.back();
  }
  if (sum != triangles) wrong(fmt::format("has {} triangles, its cells have {}", triangles, sum));
  return cells;
}

}  // namespace

void setLodInfo(tinygltf::Mesh& mesh, const LodInfo& info) {
  tinygltf::Value::Object object;
  object["lod"] = countValue(info.lod);
  object["triangles"] = countValue(info.triangles);
  object["vertices"] = countValue(info.vertices);
  object["errorObject"] = tinygltf::Value(info.errorObject);
  object["format"] = tinygltf::Value(info.measures ? kLodFormatVersion : 1);
  if (info.measures) putMeasures(object, *info.measures);
  setMember(mesh.extras, kExtras, tinygltf::Value(std::move(object)));
}

std::optional<LodInfo> lodInfo(const tinygltf::Mesh& mesh) {
  if (!mesh.extras.IsObject() || !mesh.extras.Has(kExtras)) return std::nullopt;
  const tinygltf::Value& object = mesh.extras.Get(kExtras);
  if (!object.IsObject()) malformed("extras.jalousie is not an object");
  const std::uint32_t format = memberFormat(object);
  LodInfo info;
  info.lod = memberCount(object, "lod");
  info.triangles = memberCount(object, "triangles");
  info.vertices = memberCount(object, "vertices");
  info.errorObject = memberNumber(object, "errorObject");
  if (format >= 2) info.measures = readMeasures(object, format);
  return info;
}

void setLodCells(tinygltf::Mesh& mesh, const CellTriangles& cells) {
  JAL_CHECK((mesh.extras.IsObject() && mesh.extras.Has(kExtras) && mesh.extras.Get(kExtras).Has("diagonal")));
  JAL_CHECK(cells.size() == mesh.primitives.size());
  tinygltf::Value::Array lists;
  for (const std::vector<std::uint32_t>& primitive : cells) {
    tinygltf::Value::Array counts;
    counts.reserve(primitive.size());
    for (const std::uint32_t triangles : primitive)
      counts.push_back(countValue(triangles));
    lists.emplace_back(std::move(counts));
  }
  tinygltf::Value own = mesh.extras.Get(kExtras);
  setMember(own, kCells, tinygltf::Value(tinygltf::Value::Object{{kCellTriangles, tinygltf::Value(std::move(lists))}}));
  setMember(mesh.extras, kExtras, std::move(own));
}

CellTriangles lodCells(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  if (!mesh.extras.IsObject() || !mesh.extras.Has(kExtras)) return {};
  const tinygltf::Value& object = mesh.extras.Get(kExtras);
  if (!object.Has(kCells) || memberFormat(object) < 3) return {};
  const tinygltf::Value& lists = memberObject(object, kCells).Get(kCellTriangles);
  if (!lists.IsArray()) malformed("extras.jalousie.cells.triangles is not a list");
  if (lists.ArrayLen() != mesh.primitives.size())
    malformed(
        fmt::format("extras.jalousie.cells has {} lists for {} primitives", lists.ArrayLen(), mesh.primitives.size()));
  CellTriangles cells;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    cells.push_back(readCells(lists.Get(static_cast<int>(p)), p, triangleCount(model, mesh.primitives[p])));
    if (cells.back().size() != cellCount(cells))
      malformed(fmt::format("extras.jalousie.cells: primitives 0 and {} have {} and {} cells", p, cellCount(cells),
                            cells.back().size()));
  }
  return cells;
}

void setLodChain(tinygltf::Model& model, int node, std::span<const int> lowerNodes, std::span<const float> coverage) {
  JAL_CHECK(static_cast<std::size_t>(node) < model.nodes.size());
  JAL_CHECK((coverage.empty() || coverage.size() == lowerNodes.size() + 1));
  tinygltf::Node& target = model.nodes[static_cast<std::size_t>(node)];
  tinygltf::Value::Array ids;
  for (const int lower : lowerNodes)
    ids.emplace_back(lower);
  tinygltf::Value::Array levels;
  for (const float level : coverage)
    levels.emplace_back(static_cast<double>(level));
  if (!ids.empty()) {  // the extension requires at least one id
    target.extensions[kLevels] = tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(std::move(ids))}});
    if (!levels.empty()) setMember(target.extras, kCoverage, tinygltf::Value(std::move(levels)));
    std::vector<std::string>& used = model.extensionsUsed;
    if (std::find(used.begin(), used.end(), kLevels) == used.end()) used.emplace_back(kLevels);
  }
}

namespace {

bool showsNothing(const tinygltf::Node& node) {
  return node.mesh < 0 && node.children.empty();
}

/// All nodes that MSFT_lod lists, one that shows nothing included.
std::vector<int> listedNodes(const tinygltf::Model& model, int node) {
  detail::requireIndex(node, model.nodes.size(), "node");
  const tinygltf::ExtensionMap& extensions = model.nodes[static_cast<std::size_t>(node)].extensions;
  const auto found = extensions.find(kLevels);
  if (found == extensions.end()) return {};
  if (!found->second.IsObject() || !found->second.Get("ids").IsArray())
    malformed(fmt::format("node {}: MSFT_lod has no list of ids", node));

  std::vector<int> nodes;
  const auto& ids = found->second.Get("ids").Get<tinygltf::Value::Array>();
  for (const tinygltf::Value& id : ids) {
    if (!id.IsInt()) malformed(fmt::format("node {}: MSFT_lod id is not an integer", node));
    const int lower = id.Get<int>();
    detail::requireIndex(lower, model.nodes.size(), fmt::format("node {}: MSFT_lod node", node));
    const bool isLast = nodes.size() + 1 == ids.size();
    if (!isLast && showsNothing(model.nodes[static_cast<std::size_t>(lower)]))
      malformed(fmt::format("node {}: MSFT_lod node {} has no mesh; only the last one may show nothing", node, lower));
    nodes.push_back(lower);
  }
  std::vector<int> sorted = nodes;
  sorted.push_back(node);
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    malformed(fmt::format("node {}: MSFT_lod names a node twice", node));
  return nodes;
}

bool haveMeshes(const tinygltf::Model& model, int node, const std::vector<int>& levels) {
  const auto hasMesh = [&](int of) { return model.nodes[static_cast<std::size_t>(of)].mesh >= 0; };
  return hasMesh(node) && std::all_of(levels.begin(), levels.end(), hasMesh);
}

}  // namespace

std::vector<int> lodIds(const tinygltf::Model& model, int node) {
  std::vector<int> levels = listedNodes(model, node);
  if (!levels.empty() && showsNothing(model.nodes[static_cast<std::size_t>(levels.back())])) levels.pop_back();
  return levels;
}

int emptyLevel(const tinygltf::Model& model, int node) {
  const std::vector<int> levels = listedNodes(model, node);
  const bool isEmpty = !levels.empty() && showsNothing(model.nodes[static_cast<std::size_t>(levels.back())]);
  return isEmpty ? levels.back() : -1;
}

bool isLodGroup(const tinygltf::Model& model, int node) {
  const std::vector<int> levels = lodIds(model, node);
  return !levels.empty() && !haveMeshes(model, node, levels);
}

std::vector<int> lodNodes(const tinygltf::Model& model, int node) {
  std::vector<int> levels = lodIds(model, node);
  if (!haveMeshes(model, node, levels)) levels.clear();
  return levels;
}

std::vector<float> lodCoverage(const tinygltf::Node& node) {
  if (!node.extras.IsObject() || !node.extras.Get(kCoverage).IsArray()) return {};
  std::vector<float> levels;
  for (const tinygltf::Value& value : node.extras.Get(kCoverage).Get<tinygltf::Value::Array>())
    levels.push_back(value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : 0.0F);
  return levels;
}

std::vector<float> lodThresholds(const tinygltf::Node& node, std::size_t levels) {
  if (!node.extras.IsObject() || !node.extras.Get(kCoverage).IsArray()) return {};
  std::vector<float> thresholds;
  for (const tinygltf::Value& value : node.extras.Get(kCoverage).Get<tinygltf::Value::Array>()) {
    const auto threshold = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : -1.0F;
    const float last = thresholds.empty() ? std::numeric_limits<float>::max() : thresholds.back();
    if (!(threshold >= 0.0F && threshold <= last)) return {};
    thresholds.push_back(threshold);
  }
  if (thresholds.size() > levels) thresholds.resize(levels);
  return thresholds;
}

}  // namespace jalousie::asset
