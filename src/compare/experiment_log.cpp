// Format of the log: a head with the fingerprint, then one object per step.
#include "compare/experiment_log.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/statistics_table.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::compare {
namespace {

using nlohmann::json;

constexpr int kLogVersion = 4;
constexpr std::uint64_t kMaxLogBytes = 1ULL << 31U;

std::filesystem::path logFile(const std::filesystem::path& folder) {
  return folder / kLogName;
}

/// JSON has no infinity: equal pictures have the PSNR null.
json toJson(const ImageError& error) {
  json result = {
      {"psnr", std::isinf(error.psnr) ? json() : json(error.psnr)}, {"ssim", error.ssim}, {"flip", error.flip}};
  if (error.flipCovered) result["flip_covered"] = *error.flipCovered;
  if (error.butteraugli) result["butteraugli"] = *error.butteraugli;
  return result;
}

ImageError errorFrom(const json& value) {
  const json& psnr = value.at("psnr");
  ImageError error{psnr.is_null() ? std::numeric_limits<double>::infinity() : psnr.get<double>(),
                   value.at("ssim"),
                   value.at("flip"),
                   {},
                   {}};
  if (value.contains("flip_covered")) error.flipCovered = value.at("flip_covered").get<double>();
  if (value.contains("butteraugli")) error.butteraugli = value.at("butteraugli").get<double>();
  return error;
}

json toJson(const Sample& sample) {
  json result = {{"frame", sample.frame},
                 {"configuration", sample.configuration},
                 {"frame_ms", sample.frameMs},
                 {"passes", json::array()},
                 {"lod_histogram", sample.statistics.lodHistogram}};
  for (const StatisticsField& field : kStatisticsFields)
    result[field.key] = sample.statistics.*field.value;
  for (const auto& [name, ms] : sample.passes)
    result["passes"].push_back({name, ms});
  if (sample.error) result["error"] = toJson(*sample.error);
  if (sample.visible) result["visible"] = *sample.visible;
  if (sample.lost) result["lost"] = *sample.lost;
  if (sample.wrongPixels) result["wrong_pixels"] = *sample.wrongPixels;
  if (sample.temporal) result["temporal_flip"] = *sample.temporal;
  if (sample.switched) result["visible_switched"] = *sample.switched;
  return result;
}

Sample sampleFrom(const json& value) {
  Sample sample;
  sample.frame = value.at("frame");
  sample.configuration = value.at("configuration");
  for (const StatisticsField& field : kStatisticsFields)
    sample.statistics.*field.value = value.at(field.key);
  sample.statistics.lodHistogram = value.at("lod_histogram").get<std::vector<std::uint64_t>>();
  sample.frameMs = value.at("frame_ms");
  for (const json& pass : value.at("passes"))
    sample.passes.emplace_back(pass.at(0).get<std::string>(), pass.at(1).get<double>());
  if (value.contains("error")) sample.error = errorFrom(value.at("error"));
  if (value.contains("visible")) sample.visible = value.at("visible").get<std::uint64_t>();
  if (value.contains("lost")) sample.lost = value.at("lost").get<std::uint64_t>();
  if (value.contains("wrong_pixels")) sample.wrongPixels = value.at("wrong_pixels").get<std::uint64_t>();
  if (value.contains("temporal_flip")) sample.temporal = value.at("temporal_flip").get<double>();
  if (value.contains("visible_switched")) sample.switched = value.at("visible_switched").get<std::uint64_t>();
  return sample;
}

json toJson(const KeptSample& sample) {
  return {{"frame", sample.frame},
          {"configuration", sample.configuration},
          {"frozen_mean", sample.frozenMean},
          {"frozen_largest", sample.frozenLargest},
          {"temporal", sample.temporal},
          {"subject", sample.subject}};
}

KeptSample keptFrom(const json& value) {
  return {value.at("frame"),          value.at("configuration"), value.at("frozen_mean"),
          value.at("frozen_largest"), value.at("temporal"),      value.at("subject")};
}

json toJson(const SweepSample& sample) {
  return {{"configuration", sample.configuration}, {"tau", sample.tau},          {"frame", sample.frame},
          {"triangles", sample.triangles},         {"frame_ms", sample.frameMs}, {"error", toJson(sample.error)}};
}

SweepSample sweepFrom(const json& value) {
  return {value.at("configuration"), value.at("tau"),      value.at("frame"),
          value.at("triangles"),     value.at("frame_ms"), errorFrom(value.at("error"))};
}

json toJson(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

std::optional<double> maybeFrom(const json& value) {
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

json toJson(const ObjectFigures& object) {
  json result = {{"object", object.object},
                 {"chain", object.chain},
                 {"drawn", object.drawn},
                 {"level", object.level},
                 {"tessellation", object.tessellation},
                 {"triangles", object.triangles},
                 {"pixels", object.pixels},
                 {"allowed", toJson(object.allowed)},
                 {"error", toJson(object.errorPixels)},
                 {"flip", object.flip},
                 {"finer", nullptr}};
  if (object.finer)
    result["finer"] = {{"triangles", object.finer->triangles}, {"error", toJson(object.finer->errorPixels)}};
  return result;
}

ObjectFigures objectFrom(const json& value) {
  ObjectFigures object;
  object.object = value.at("object");
  object.chain = value.at("chain");
  object.drawn = value.at("drawn");
  object.level = value.at("level");
  object.tessellation = value.at("tessellation");
  object.triangles = value.at("triangles");
  object.pixels = value.at("pixels");
  object.allowed = maybeFrom(value.at("allowed"));
  object.errorPixels = maybeFrom(value.at("error"));
  object.flip = value.at("flip");
  if (const json& finer = value.at("finer"); !finer.is_null())
    object.finer = OtherLevel{finer.at("triangles"), maybeFrom(finer.at("error"))};
  return object;
}

json toJson(const ObjectsSample& sample) {
  json rows = json::array();
  for (const ObjectFigures& object : sample.rows)
    rows.push_back(toJson(object));
  return {{"frame", sample.frame}, {"configuration", sample.configuration},         {"listed", sample.listed},
          {"flip", sample.flip},   {"flip_of_background", sample.flipOfBackground}, {"rows", std::move(rows)}};
}

ObjectsSample objectsFrom(const json& value) {
  ObjectsSample sample{value.at("frame"), value.at("configuration"),      value.at("listed"),
                       value.at("flip"),  value.at("flip_of_background"), {}};
  for (const json& object : value.at("rows"))
    sample.rows.push_back(objectFrom(object));
  return sample;
}

Results stepFrom(const json& line) {
  Results results;
  for (const json& value : line.at("samples"))
    results.samples.push_back(sampleFrom(value));
  for (const json& value : line.at("kept"))
    results.kept.push_back(keptFrom(value));
  for (const json& value : line.at("sweep"))
    results.sweep.push_back(sweepFrom(value));
  for (const json& value : line.at("objects"))
    results.objects.push_back(objectsFrom(value));
  return results;
}

}  // namespace

void startLog(const std::filesystem::path& folder, const std::string& fingerprint) {
  writeFileAtomic(logFile(folder), json({{"log", kLogVersion}, {"experiment", fingerprint}}).dump() + "\n");
}

void appendLog(const std::filesystem::path& folder, const Results& step) {
  json line = {
      {"samples", json::array()}, {"kept", json::array()}, {"sweep", json::array()}, {"objects", json::array()}};
  for (const Sample& sample : step.samples)
    line["samples"].push_back(toJson(sample));
  for (const KeptSample& sample : step.kept)
    line["kept"].push_back(toJson(sample));
  for (const SweepSample& sample : step.sweep)
    line["sweep"].push_back(toJson(sample));
  for (const ObjectsSample& sample : step.objects)
    line["objects"].push_back(toJson(sample));
  appendToFile(logFile(folder), line.dump() + "\n");
}

bool holdsLog(const std::filesystem::path& folder) {
  std::ifstream file(logFile(folder));
  std::string head;
  if (!std::getline(file, head)) return false;
  const json line = json::parse(head, nullptr, /*allow_exceptions=*/false);
  return line.is_object() && line.contains("log") && line.contains("experiment");
}

std::size_t readLog(const std::filesystem::path& folder, const std::string& fingerprint, Results& results) {
  const std::filesystem::path file = logFile(folder);
  if (!std::filesystem::exists(file)) return 0;
  const std::vector<std::byte> bytes = readFile(file, kMaxLogBytes);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::size_t steps = 0;
  std::string whole;  // the lines that are complete
  try {
    for (bool head = true; !text.empty(); head = false) {
      const std::size_t end = text.find('\n');
      if (end == std::string_view::npos) break;  // an interruption cut the line off
      const json line = json::parse(text.substr(0, end));
      if (head) {
        if (line.at("log") != kLogVersion || line.at("experiment") != fingerprint) {
          throw Error(
              ErrorCode::kUsage,
              "holds another experiment (scene, path, options, driver or program differ); choose another folder, "
              "or say --force instead of --resume to replace it",
              folder);
        }
      } else {
        append(results, stepFrom(line));
        ++steps;
      }
      whole += std::string(text.substr(0, end + 1));
      text.remove_prefix(end + 1);
    }
  } catch (const json::exception& error) {
    throw Error(ErrorCode::kMalformed, fmt::format("is no log of an experiment ({})", error.what()), file);
  }
  if (!text.empty()) writeFileAtomic(file, whole);
  return steps;
}

}  // namespace jalousie::compare
