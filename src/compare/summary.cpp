// Medians, ratios to the baseline, figures of the sweep.
#include "compare/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "compare/configuration.h"
#include "compare/curves.h"
#include "compare/spread.h"
#include "compare/statistics_table.h"
#include "core/check.h"
#include "scene/scene_names.h"

namespace jalousie::compare {
namespace {

using nlohmann::ordered_json;

/// Errors at which the curves' costs are compared.
constexpr double kFlipBudgets[] = {0.01, 0.02, 0.05};

using Curve = std::vector<CurvePoint>;

ordered_json toJson(const Spread& spread) {
  return {{"median", spread.median}, {"q1", spread.lower}, {"q3", spread.upper}};
}

/// JSON has no infinity: equal pictures have the PSNR null.
ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

template <class Get>
std::vector<double> valuesOf(const std::vector<const Sample*>& samples, Get get) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample* sample : samples)
    values.push_back(static_cast<double>(get(*sample)));
  return values;
}

/// Samples of one configuration, ascending by frame.
std::vector<const Sample*> samplesOf(const Results& results, std::size_t configuration) {
  std::vector<const Sample*> samples;
  for (const Sample& sample : results.samples)
    if (sample.configuration == configuration) samples.push_back(&sample);
  return samples;
}

ordered_json errorJson(const std::vector<const Sample*>& samples) {
  std::vector<double> flips;
  std::vector<double> squares;
  std::vector<double> similarities;
  std::vector<double> masked;
  std::vector<double> covered;
  for (const Sample* sample : samples) {
    if (!sample->error) continue;
    flips.push_back(sample->error->flip);
    squares.push_back(meanSquaredError(sample->error->psnr));
    similarities.push_back(sample->error->ssim);
    if (sample->error->flipCovered) covered.push_back(*sample->error->flipCovered);
    if (sample->error->butteraugli) masked.push_back(*sample->error->butteraugli);
  }
  if (flips.empty()) return nullptr;
  const auto spread = [](const std::vector<double>& values) {
    return ordered_json{{"mean", meanOf(values)}, {"largest", *std::max_element(values.begin(), values.end())}};
  };
  return {{"flip", spread(flips)},
          {"flip_covered", covered.empty() ? ordered_json(nullptr) : spread(covered)},
          {"psnr",
           {{"mean", finite(psnrOf(meanOf(squares)))},
            {"least", finite(psnrOf(*std::max_element(squares.begin(), squares.end())))}}},
          {"ssim",
           {{"mean", meanOf(similarities)}, {"least", *std::min_element(similarities.begin(), similarities.end())}}},
          {"butteraugli", masked.empty() ? ordered_json(nullptr) : spread(masked)}};
}

/// Visible objects and how many times as many were drawn; null without pictures.
void addVisible(ordered_json& json, const std::vector<const Sample*>& samples) {
  std::vector<double> visible;
  std::vector<double> ratio;
  for (const Sample* sample : samples) {
    if (!sample->visible) continue;
    visible.push_back(static_cast<double>(*sample->visible));
    if (*sample->visible > 0) ratio.push_back(static_cast<double>(sample->statistics.drawn) / visible.back());
  }
  json["visible"] = visible.empty() ? ordered_json(nullptr) : toJson(spreadOf(visible));
  json["drawn_per_visible"] = ratio.empty() ? ordered_json(nullptr) : toJson(spreadOf(ratio));
}

/// Counts of a technique; null where it was not used.
ordered_json groupJson(const CountGroup& group, const std::vector<const Sample*>& samples) {
  const bool used = std::any_of(samples.begin(), samples.end(), [&](const Sample* s) {
    return s->statistics.*group.leads > 0 || s->statistics.*group.orLeads > 0;
  });
  if (!used) return nullptr;
  ordered_json json;
  for (const char* key : group.keys) {
    const auto value = statisticsField(key).value;
    json[key] = toJson(spreadOf(valuesOf(samples, [&](const Sample& s) { return s.statistics.*value; })));
  }
  return json;
}

/// Objects and pixels that culling lost; null without pictures.
ordered_json lostJson(const std::vector<const Sample*>& samples) {
  std::uint64_t objects = 0;
  std::uint64_t pixels = 0;
  std::uint64_t frames = 0;
  bool known = false;
  for (const Sample* sample : samples) {
    if (!sample->lost || !sample->wrongPixels) continue;
    known = true;
    objects = std::max(objects, *sample->lost);
    pixels = std::max(pixels, *sample->wrongPixels);
    frames += *sample->wrongPixels > 0 ? 1 : 0;
  }
  if (!known) return nullptr;
  return {{"objects_most", objects}, {"pixels_most", pixels}, {"frames", frames}};
}

/// Level switches and the change that they make. Temporal FLIP is the mean over all frames of a path without gaps, else
/// over the kept frames.
ordered_json poppingJson(const Results& results, const std::vector<const Sample*>& samples, std::size_t configuration) {
  ordered_json json;
  double visible = 0.0;
  double switched = 0.0;
  for (const Sample* sample : samples) {
    if (!sample->switched) continue;
    visible += static_cast<double>(sample->visible.value_or(0));
    switched += static_cast<double>(*sample->switched);
  }
  json["switches_per_visible_object"] = visible > 0.0 ? ordered_json(switched / visible) : ordered_json(nullptr);
  std::vector<double> frozen;
  std::vector<double> temporal;
  double largest = 0.0;
  for (const KeptSample& kept : results.kept) {
    if (kept.configuration != configuration) continue;
    frozen.push_back(kept.frozenMean);
    largest = std::max(largest, kept.frozenLargest);
    temporal.push_back(kept.temporal);
  }
  std::vector<double> alongPath;
  for (const Sample* sample : samples)
    if (sample->temporal) alongPath.push_back(*sample->temporal);
  if (!alongPath.empty()) temporal = std::move(alongPath);
  json["frozen_flip_mean"] = frozen.empty() ? ordered_json(nullptr) : ordered_json(meanOf(frozen));
  json["frozen_flip_largest"] = frozen.empty() ? ordered_json(nullptr) : ordered_json(largest);
  json["temporal_flip"] = temporal.empty() ? ordered_json(nullptr) : ordered_json(meanOf(temporal));
  return json;
}

ordered_json passesJson(const std::vector<const Sample*>& samples) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> times;
  for (const Sample* sample : samples) {
    for (const auto& [name, ms] : sample->passes) {
      if (!times.contains(name)) order.push_back(name);
      times[name].push_back(ms);
    }
  }
  ordered_json json = ordered_json::object();
  for (const std::string& name : order)  // median time, times the share of frames in which the pass ran
    json[name] = spreadOf(times[name]).median * static_cast<double>(times[name].size()) /
                 static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  return json;
}

/// Ratios of a figure to the baseline, frame by frame; frames where the baseline's figure is 0 are left out.
std::vector<double> ratios(const std::vector<const Sample*>& samples, const std::vector<const Sample*>& baseline,
                           auto get) {
  std::vector<double> result;
  for (std::size_t i = 0; i < std::min(samples.size(), baseline.size()); ++i) {
    JAL_CHECK(samples[i]->frame == baseline[i]->frame);
    const auto of = static_cast<double>(get(*baseline[i]));
    if (of > 0.0) result.push_back(static_cast<double>(get(*samples[i])) / of);
  }
  return result;
}

std::uint64_t totalTriangles(const std::vector<const Sample*>& samples) {
  std::uint64_t sum = 0;
  for (const Sample* sample : samples)
    sum += sample->statistics.triangles;
  return sum;
}

/// Mean number of drawn objects per level.
std::vector<double> meanHistogram(const std::vector<const Sample*>& samples) {
  std::vector<double> histogram;
  for (const Sample* sample : samples) {
    const std::vector<std::uint64_t>& levels = sample->statistics.lodHistogram;
    histogram.resize(std::max(histogram.size(), levels.size()));
    for (std::size_t k = 0; k < levels.size(); ++k)
      histogram[k] += static_cast<double>(levels[k]) / static_cast<double>(samples.size());
  }
  return histogram;
}

/// JSON of a value that may be absent.
ordered_json orNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json objectJson(const ObjectFigures& object, const scene::SceneNames& names) {
  ordered_json json = {{"object", object.object},
                       {"name", scene::shownName(names, object.object, object.chain)},
                       {"mesh", std::string(names.meshName(object.chain).substr(0, scene::kLongestShownName))}};
  const auto ifDrawn = [&](const auto& value) { return object.drawn ? ordered_json(value) : ordered_json(nullptr); };
  json["level"] = ifDrawn(object.level);
  json["tessellation"] = object.tessellation > 0 ? ordered_json(object.tessellation) : ordered_json(nullptr);
  json["triangles"] = ifDrawn(object.triangles);
  json["pixels"] = object.pixels;
  json["error_allowed_px"] = orNull(object.allowed);
  json["error_px"] = orNull(object.errorPixels);
  json["flip"] = object.flip;
  json["finer"] = nullptr;
  if (object.finer)
    json["finer"] = {{"triangles", object.finer->triangles}, {"error_px", orNull(object.finer->errorPixels)}};
  return json;
}

/// The objects of one configuration; null where they have not been listed.
ordered_json objectsJson(const Results& results, std::size_t configuration, const Circumstances& circumstances) {
  const auto found = std::find_if(results.objects.begin(), results.objects.end(),
                                  [&](const ObjectsSample& s) { return s.configuration == configuration; });
  if (found == results.objects.end()) return nullptr;
  const scene::SceneNames none;
  ordered_json rows = ordered_json::array();
  for (const ObjectFigures& object : found->rows)
    rows.push_back(objectJson(object, circumstances.names != nullptr ? *circumstances.names : none));
  return {{"frame", found->frame},
          {"count", found->listed},
          {"flip", found->flip},
          {"flip_of_background", found->flipOfBackground},
          {"rows", std::move(rows)}};
}

ordered_json configurationJson(const Results& results, const Configuration& configuration, std::size_t index,
                               const std::vector<const Sample*>& baseline) {
  const std::vector<const Sample*> samples = samplesOf(results, index);
  const auto spread = [&](auto get) { return toJson(spreadOf(valuesOf(samples, get))); };
  const auto triangles = [](const Sample& s) { return s.statistics.triangles; };
  const auto time = [](const Sample& s) { return s.frameMs; };
  ordered_json json;
  json["name"] = configuration.name;
  json["options"] = configuration.commandLine;
  json["frames"] = samples.size();
  json["triangles"] = spread(triangles);
  json["triangles_total"] = totalTriangles(samples);
  json["triangles_ratio"] = toJson(spreadOf(ratios(samples, baseline, triangles)));
  json["frame_ms"] = spread(time);
  json["frame_ratio"] = toJson(spreadOf(ratios(samples, baseline, time)));
  json["passes_ms"] = passesJson(samples);
  json["draws"] = spread([](const Sample& s) { return s.statistics.draws; });
  json["drawn"] = spread([](const Sample& s) { return s.statistics.drawn; });
  addVisible(json, samples);
  for (const CountGroup& group : kCountGroups)
    json[group.name] = groupJson(group, samples);
  json["culled_frustum"] = spread([](const Sample& s) { return s.statistics.culledFrustum; });
  json["culled_occlusion"] = spread([](const Sample& s) { return s.statistics.culledOcclusion; });
  json["lod_histogram_mean"] = meanHistogram(samples);
  json["lost"] = lostJson(samples);
  json["error"] = errorJson(samples);
  json["popping"] = poppingJson(results, samples, index);
  return json;
}

ordered_json pointJson(const CurvePoint& point) {
  return {{"tau", point.tau},
          {"triangles", point.triangles},
          {"frame_ms", point.frameMs},
          {"flip", point.flip},
          {"psnr", finite(point.psnr)},
          {"ssim", point.ssim},
          {"butteraugli", orNull(point.butteraugli)}};
}

ordered_json curvesJson(const std::vector<Configuration>& configurations, const std::vector<Curve>& curves) {
  ordered_json json = ordered_json::array();
  for (std::size_t c = 0; c < configurations.size(); ++c) {
    if (curves[c].empty()) continue;
    ordered_json points = ordered_json::array();
    for (const CurvePoint& point : curves[c])
      points.push_back(pointJson(point));
    json.push_back({{"name", configurations[c].name}, {"points", points}});
  }
  return json;
}

ordered_json paretoJson(const std::vector<Configuration>& configurations, const std::vector<Curve>& curves) {
  std::vector<CurvePoint> points;
  std::vector<std::size_t> owners;  // [points], index of the configuration
  for (std::size_t c = 0; c < curves.size(); ++c) {
    points.insert(points.end(), curves[c].begin(), curves[c].end());
    owners.insert(owners.end(), curves[c].size(), c);
  }
  ordered_json json = ordered_json::array();
  for (const std::size_t i : paretoFront(points)) {
    json.push_back({{"name", configurations[owners[i]].name},
                    {"tau", points[i].tau},
                    {"triangles", points[i].triangles},
                    {"flip", points[i].flip}});
  }
  return json;
}

/// What every curve has at one place, by name of its configuration. @param at  of a curve; absent outside its range
ordered_json byName(const std::vector<Configuration>& configurations, const std::vector<Curve>& curves, auto at) {
  ordered_json json = ordered_json::object();
  for (std::size_t c = 0; c < configurations.size(); ++c)
    if (!curves[c].empty()) json[configurations[c].name] = orNull(at(curves[c]));
  return json;
}

ordered_json trianglesAtFlipJson(const std::vector<Configuration>& configurations, const std::vector<Curve>& curves) {
  ordered_json rows = ordered_json::array();
  for (const double budget : kFlipBudgets)
    rows.push_back({{"flip", budget}, {"triangles", byName(configurations, curves, [&](const Curve& curve) {
                                         return trianglesAtFlip(curve, budget);
                                       })}});
  return rows;
}

/// FLIP of all curves at the triangles of each point of one curve. @param base  index of a curve that is not empty
ordered_json flipAtTrianglesJson(const std::vector<Configuration>& configurations, const std::vector<Curve>& curves,
                                 std::size_t base) {
  ordered_json rows = ordered_json::array();
  for (const CurvePoint& point : curves[base]) {
    rows.push_back({{"tau", point.tau},
                    {"triangles", point.triangles},
                    {"flip", byName(configurations, curves,
                                    [&](const Curve& curve) { return flipAtTriangles(curve, point.triangles); })}});
  }
  return {{"of", configurations[base].name}, {"rows", rows}};
}

/// Null without a sweep, and until some tau has been measured at all kept frames.
ordered_json sweepJson(const Results& results, const std::vector<Configuration>& configurations, const Plan& plan) {
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < configurations.size(); ++c)
    curves.push_back(curveOf(results, c, plan.keptFrames().size()));
  if (std::all_of(curves.begin(), curves.end(), [](const Curve& curve) { return curve.empty(); })) return nullptr;
  std::size_t base = plan.baseline;  // or the next configuration that has a curve
  while (curves[base].empty())
    base = (base + 1) % curves.size();
  ordered_json json;
  json["curves"] = curvesJson(configurations, curves);
  json["pareto"] = paretoJson(configurations, curves);
  json["triangles_at_flip"] = trianglesAtFlipJson(configurations, curves);
  json["flip_at_triangles"] = flipAtTrianglesJson(configurations, curves, base);
  return json;
}

/// 1234567 -> "1.23 M".
std::string shortCount(double value) {
  if (value >= 1e6) return fmt::format("{:.2f} M", value / 1e6);
  if (value >= 1e4) return fmt::format("{:.0f} k", value / 1e3);
  return fmt::format("{:.0f}", value);
}

std::string orDash(const ordered_json& value, const char* format) {
  return value.is_null() ? "-" : fmt::format(fmt::runtime(format), value.get<double>());
}

/// @param error  of errorJson()
std::string psnrText(const ordered_json& error) {
  if (error.is_null()) return "-";
  const ordered_json& mean = error.at("psnr").at("mean");
  return mean.is_null() ? "equal" : fmt::format("{:.2f}", mean.get<double>());
}

}  // namespace

ordered_json summaryJson(const Results& results, const std::vector<Configuration>& configurations, const Plan& plan,
                         const Circumstances& circumstances) {
  const char* const references[] = {"none", "lod0", "full"};
  ordered_json json;
  json["version"] = circumstances.version;
  json["complete"] = results.complete;
  json["scene"] = circumstances.scene;
  json["path"] = circumstances.path;
  json["command"] = circumstances.command;
  json["renderer"] = circumstances.renderer;
  json["timing"] = circumstances.timing;
  json["ignored"] = ordered_json(circumstances.ignored);
  json["width"] = plan.width;
  json["height"] = plan.height;
  json["frames"] = {{"first", plan.range.first},           {"last", plan.range.last}, {"step", plan.range.step},
                    {"count", plan.range.frames().size()}, {"lead", plan.lead},       {"kept", plan.keptFrames()}};
  json["reference"] = references[static_cast<int>(plan.reference)];
  json["pixels_per_degree"] = plan.pixelsPerDegree;
  json["baseline"] = configurations[plan.baseline].name;
  json["triangles_full"] = results.samples.empty() ? 0 : results.samples.front().statistics.trianglesFinest;
  json["objects"] = results.samples.empty() ? 0 : results.samples.front().statistics.objects;
  const std::vector<const Sample*> baseline = samplesOf(results, plan.baseline);
  json["configurations"] = ordered_json::array();
  for (std::size_t c = 0; c < configurations.size(); ++c) {
    json["configurations"].push_back(configurationJson(results, configurations[c], c, baseline));
    json["configurations"].back()["worst_objects"] = objectsJson(results, c, circumstances);
  }
  json["sweep"] = sweepJson(results, configurations, plan);
  return json;
}

std::string summaryText(const ordered_json& summary) {
  const ordered_json& configurations = summary.at("configurations");
  const auto isJudged = [](const ordered_json& c) {
    return !c.at("error").is_null() && !c.at("error").at("butteraugli").is_null();
  };
  const auto asks = [](const ordered_json& c) { return !c.at("queries").is_null(); };
  const bool judged = std::any_of(configurations.begin(), configurations.end(), isJudged);
  const bool asked = std::any_of(configurations.begin(), configurations.end(), asks);
  std::string text =
      fmt::format("{:<28} {:>9} {:>10} {:>7} {:>10} {:>7} {:>8} {:>8} {:>8} {:>13}{}{}\n", "configuration", "lost px",
                  "triangles", "ratio", "frame ms", "ratio", "FLIP", "PSNR", "switches", "drawn/visible",
                  judged ? " Butteraugli" : "", asked ? "  queries  round trips  state changes  draw calls" : "");
  for (const ordered_json& c : configurations) {
    const auto median = [&](const char* key) { return c.at(key).at("median").get<double>(); };
    const ordered_json& error = c.at("error");
    const std::string flip = error.is_null() ? "-" : orDash(error.at("flip").at("mean"), "{:.4f}");
    const ordered_json& lost = c.at("lost");
    text += fmt::format(
        "{:<28} {:>9} {:>10} {:>7.2f} {:>10.1f} {:>7.2f} {:>8} {:>8} {:>8}", c.at("name").get<std::string>(),
        lost.is_null() ? "-" : std::to_string(lost.at("pixels_most").get<std::uint64_t>()),
        shortCount(median("triangles")), median("triangles_ratio"), median("frame_ms"), median("frame_ratio"), flip,
        psnrText(error), orDash(c.at("popping").at("switches_per_visible_object"), "{:.4f}"));
    const ordered_json& perVisible = c.at("drawn_per_visible");
    text += fmt::format(" {:>13}", perVisible.is_null() ? "-" : orDash(perVisible.at("median"), "{:.2f}"));
    if (judged)
      text += fmt::format(" {:>11}", isJudged(c) ? orDash(error.at("butteraugli").at("mean"), "{:.4f}") : "-");
    const auto count = [&](const char* key) {
      return asks(c) ? fmt::format("{:.0f}", c.at("queries").at(key).at("median").get<double>()) : std::string("-");
    };
    if (asked)
      text += fmt::format(" {:>8} {:>12} {:>14} {:>11.0f}", count("queries"), count("query_round_trips"),
                          count("query_switches"), median("draws"));
    text += "\n";
  }
  return text;
}

}  // namespace jalousie::compare
