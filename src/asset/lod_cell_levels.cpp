// Reads and checks the groups of cells. Errors are written with four digits, rounded up.
#include "asset/lod_cell_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "asset/extras.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kOwnExtras = "jalousie";
constexpr const char* kCellLevels = "cellLevels";
constexpr const char* kProducers = "producers";
constexpr const char* kGroups = "groups";
constexpr const char* kMax = "max";
constexpr const char* kMean = "mean";
constexpr double kFirstFormat = 6.0;

[[noreturn]] void wrongLevels(const std::string& what) {
  throw Error(ErrorCode::kMalformed, "extras.jalousie.cellLevels" + what);
}

/// The next larger number of four digits, so that tables are short. The order of numbers stays.
double roundedUp(double value) {
  if (!(value > 0.0)) return 0.0;
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  const double nearest = std::stod(fmt::format("{:.3e}", value));
  return nearest >= value ? nearest : std::stod(fmt::format("{:.3e}", value + digit));
}

tinygltf::Value countsValue(const std::vector<std::uint32_t>& counts) {
  tinygltf::Value::Array values;
  values.reserve(counts.size());
  for (const std::uint32_t count : counts)
    values.push_back(countValue(count));
  return tinygltf::Value(std::move(values));
}

/// A list of one member; empty if it is absent, because readers drop empty lists.
tinygltf::Value::Array listIn(const tinygltf::Value& object, const char* key) {
  if (!object.Has(key)) return {};
  const tinygltf::Value& list = object.Get(key);
  if (!list.IsArray()) wrongLevels(fmt::format(".{} is not a list", key));
  return list.Get<tinygltf::Value::Array>();
}

std::vector<std::uint32_t> countsOf(const tinygltf::Value& object, const char* key) {
  std::vector<std::uint32_t> counts;
  for (const tinygltf::Value& value : listIn(object, key)) {
    const std::optional<std::uint32_t> count = countIn(value);
    if (!count) wrongLevels(fmt::format(".{}: entry {} is no count", key, counts.size()));
    counts.push_back(*count);
  }
  return counts;
}

std::vector<double> lengthsOf(const tinygltf::Value& object, const char* key) {
  std::vector<double> lengths;
  for (const tinygltf::Value& value : listIn(object, key)) {
    const double length = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
    if (!(length >= 0.0) || !std::isfinite(static_cast<float>(length)))
      wrongLevels(fmt::format(".{}: entry {} is no length", key, lengths.size()));
    lengths.push_back(length);
  }
  return lengths;
}

std::uint64_t sumOf(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Checks the numbers of a level against its cells.
void checkCells(const LodCellLevels& level, const CellTriangles& cells) {
  const std::uint64_t produced = sumOf(level.producedCells);
  if (!level.producedCells.empty() && !level.groupOf.empty() && produced != level.groupOf.size())
    wrongLevels(fmt::format(": its producers have {} cells, its groups have {}", produced, level.groupOf.size()));
  const std::uint64_t filled = level.groupOf.empty() ? produced : level.groupOf.size();
  if (filled > cellCount(cells)) wrongLevels(fmt::format(" counts {} cells of {}", filled, cellCount(cells)));
  for (const std::vector<std::uint32_t>& primitive : cells)
    for (std::size_t cell = filled; cell < primitive.size(); ++cell)
      if (primitive[cell] > 0) wrongLevels(fmt::format(": cell {} has triangles and is in no group", cell));
}

/// Checks the groups of a level: each has a cell.
void checkGroups(const LodCellLevels& level) {
  std::vector<std::uint8_t> hasCell(level.errors.size(), 0);
  for (std::size_t cell = 0; cell < level.groupOf.size(); ++cell) {
    if (level.groupOf[cell] >= level.errors.size())
      wrongLevels(fmt::format(": cell {} is in group {} of {}", cell, level.groupOf[cell], level.errors.size()));
    hasCell[level.groupOf[cell]] = 1;
  }
  const auto without = std::find(hasCell.begin(), hasCell.end(), 0);
  if (without != hasCell.end()) wrongLevels(fmt::format(": group {} has no cell", without - hasCell.begin()));
  for (std::size_t group = 0; group < level.errors.size(); ++group)
    if (level.errors[group].mean > level.errors[group].max)
      wrongLevels(fmt::format(": the mean of group {} is larger than its maximum", group));
}

/// Errors may not fall from a group to the one that its cells belong to.
void checkErrors(const LodCellLevels& finer, const LodCellLevels& coarser, std::size_t k) {
  std::size_t cell = 0;
  for (std::size_t producer = 0; producer < coarser.producedCells.size(); ++producer) {
    for (std::uint32_t i = 0; i < coarser.producedCells[producer]; ++i, ++cell) {
      if (coarser.groupOf.empty()) continue;
      const DistanceInfo& own = coarser.errors[coarser.groupOf[cell]];
      if (own.max < finer.errors[producer].max || own.mean < finer.errors[producer].mean)
        wrongLevels(fmt::format(" of level {}: the error of group {} is less than that of a group below it", k,
                                coarser.groupOf[cell]));
    }
  }
}

}  // namespace

std::uint32_t filledCells(const LodCellLevels& level) {
  return static_cast<std::uint32_t>(level.groupOf.empty() ? sumOf(level.producedCells) : level.groupOf.size());
}

void setLodCellLevels(tinygltf::Mesh& mesh, const LodCellLevels& levels) {
  if (levels.empty()) return;
  JAL_CHECK((mesh.extras.IsObject() && mesh.extras.Has(kOwnExtras) && mesh.extras.Get(kOwnExtras).Has("cells")));
  tinygltf::Value::Object object;
  if (!levels.producedCells.empty()) object[kProducers] = countsValue(levels.producedCells);
  if (!levels.groupOf.empty()) {
    object[kGroups] = countsValue(levels.groupOf);
    tinygltf::Value::Array largest;
    tinygltf::Value::Array means;
    for (const DistanceInfo& error : levels.errors) {
      largest.emplace_back(roundedUp(error.max));
      means.emplace_back(roundedUp(std::min(error.mean, error.max)));
    }
    object[kMax] = tinygltf::Value(std::move(largest));
    object[kMean] = tinygltf::Value(std::move(means));
  }
  tinygltf::Value own = mesh.extras.Get(kOwnExtras);
  setMember(own, kCellLevels, tinygltf::Value(std::move(object)));
  setMember(mesh.extras, kOwnExtras, std::move(own));
}

LodCellLevels lodCellLevels(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  const std::optional<LodInfo> info = lodInfo(mesh);  // checks the number of the format
  if (!info || !info->measures) return {};
  const tinygltf::Value& own = mesh.extras.Get(kOwnExtras);
  if (!own.Has(kCellLevels) || own.Get("format").GetNumberAsDouble() < kFirstFormat) return {};
  const tinygltf::Value& object = own.Get(kCellLevels);
  if (!object.IsObject()) wrongLevels(" is not an object");
  LodCellLevels levels;
  levels.producedCells = countsOf(object, kProducers);
  levels.groupOf = countsOf(object, kGroups);
  const std::vector<double> largest = lengthsOf(object, kMax);
  const std::vector<double> means = lengthsOf(object, kMean);
  if (largest.size() != means.size())
    wrongLevels(fmt::format(" has {} maxima and {} means", largest.size(), means.size()));
  for (std::size_t group = 0; group < largest.size(); ++group)
    levels.errors.push_back({largest[group], means[group]});
  if (levels.empty()) wrongLevels(" has neither producers nor groups");
  checkCells(levels, lodCells(model, mesh));
  checkGroups(levels);
  return levels;
}

void requireHierarchy(std::span<const LodCellLevels> levels) {
  const auto hasNone = [](const LodCellLevels& level) { return level.empty(); };
  if (std::all_of(levels.begin(), levels.end(), hasNone)) return;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels[k].empty()) wrongLevels(fmt::format(": level {} has none", k));
    if (levels[k].producedCells.empty() != (k == 0))
      wrongLevels(fmt::format(" of level {}: {}", k, k == 0 ? "LOD 0 has producers" : "it has no producers"));
    if (levels[k].groupOf.empty() != (k + 1 == levels.size()))
      wrongLevels(fmt::format(" of level {}: {}", k,
                              levels[k].groupOf.empty() ? "it has no groups" : "it is the last one and has groups"));
    if (k == 0) continue;
    if (levels[k].producedCells.size() != levels[k - 1].errors.size())
      wrongLevels(fmt::format(" of level {}: it has {} producers, the finer level has {} groups", k,
                              levels[k].producedCells.size(), levels[k - 1].errors.size()));
    checkErrors(levels[k - 1], levels[k], k);
  }
}

}  // namespace jalousie::asset
