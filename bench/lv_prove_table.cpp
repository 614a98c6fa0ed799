// Prints the proving table as Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "equal_error.h"
#include "lv_prove.h"

namespace jalousie::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kErrors = 4;  // that a ratio is the mean over
constexpr const char* kParts[] = {"still", "moving"};
constexpr const char* kColumns =
    " still: PSNR | SSIM | FLIP | moving: PSNR | SSIM | FLIP | switches (baseline) | frame time | wrong pixels |";

double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::string text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.2f}", value);
}

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.2f} %", 100.0 * share);
}

/// A mean ratio; in brackets the number of errors that it rests on, if some are missing.
std::string ratioText(const Json& part, const char* measure) {
  const std::string ratio = text(number(part.value(measure, Json())));
  const int errors = part.contains("errors") ? part["errors"].value(measure, 0) : kErrors;
  return errors == 0 || errors == kErrors ? ratio : fmt::format("{} ({})", ratio, errors);
}

/// Everything of a line but its names.
void printFigures(const Json& row) {
  for (const char* part : kParts)
    for (const ErrorMeasure& measure : kMeasures)
      fmt::print(" {} |", ratioText(row[part], measure.name));
  fmt::print(" {} ({}) | {} | {} |\n", percent(number(row["switches"])), percent(number(row["switches_of_baseline"])),
             text(number(row["frame_ratio"])), row["wrong_pixels"].is_null() ? "-" : row["wrong_pixels"].dump());
}

/// Rows of one candidate, reduced to one number each.
template <class Value, class Reduce>
Json reduced(const std::vector<Json>& rows, Value&& valueOf, Reduce&& reduce) {
  std::vector<double> values;
  for (const Json& row : rows)
    if (const double value = valueOf(row); !std::isnan(value)) values.push_back(value);
  return values.empty() ? Json() : orNull(reduce(values));
}

double arithmeticMean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

/// The means of one candidate, with the keys of a row.
Json meanOfRows(const std::string& candidate, const std::vector<Json>& rows) {
  Json mean = {{"candidate", candidate}, {"views", rows.size()}};
  for (const char* part : kParts)
    for (const ErrorMeasure& measure : kMeasures)
      mean[part][measure.name] = reduced(
          rows, [&](const Json& row) { return number(row[part].value(measure.name, Json())); }, geometricMean);
  const auto at = [](const char* key) { return [key](const Json& row) { return number(row[key]); }; };
  mean["switches"] = reduced(rows, at("switches"), arithmeticMean);
  mean["switches_of_baseline"] = reduced(rows, at("switches_of_baseline"), arithmeticMean);
  mean["frame_ratio"] = reduced(rows, at("frame_ratio"), geometricMean);
  const Json wrong =
      reduced(rows, at("wrong_pixels"), [](const std::vector<double>& all) { return *std::ranges::max_element(all); });
  mean["wrong_pixels"] = wrong.is_null() ? wrong : Json(static_cast<std::uint64_t>(wrong.get<double>()));
  return mean;
}

}  // namespace

void printProveHead() {
  fmt::print(
      "Triangles and frame times over those of hiz + pixel-error on whole objects\n\n| scene | view | candidate |{}"
      "\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      kColumns);
  std::fflush(stdout);
}

void printProveRows(const Json& figures, std::size_t first) {
  for (std::size_t i = first; i < figures["rows"].size(); ++i) {
    const Json& row = figures["rows"][i];
    fmt::print("| {} | {} | {} |", std::filesystem::path(row["scene"].get<std::string>()).stem().string(),
               row["view"].get<std::string>(), row["candidate"].get<std::string>());
    printFigures(row);
  }
  std::fflush(stdout);
}

void printProveMeans(Json& figures) {
  figures["means"] = Json::array();
  for (const std::string& candidate : proveCandidates()) {
    std::vector<Json> rows;
    for (const Json& row : figures["rows"])
      if (row["candidate"] == candidate) rows.push_back(row);
    if (!rows.empty()) figures["means"].push_back(meanOfRows(candidate, rows));
  }
  fmt::print(
      "\nGeometric means of the ratios, arithmetic means of the switches, most wrong pixels\n\n| candidate | views |{}"
      "\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      kColumns);
  for (const Json& mean : figures["means"]) {
    fmt::print("| {} | {} |", mean["candidate"].get<std::string>(), mean["views"].get<std::size_t>());
    printFigures(mean);
  }
}

}  // namespace jalousie::bench
