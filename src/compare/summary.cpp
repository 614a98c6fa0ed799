// Medians, ratios, curves.
#include "compare/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/check.h"

namespace jalousie::compare {
namespace {

using nlohmann::ordered_json;

constexpr double kFlipBudgets[] = {0.01, 0.02, 0.05};

ordered_json toJson(const Spread& spread) {
  return {{"median", spread.median}, {"q1", spread.lower}, {"q3", spread.upper}};
}

/// JSON has no infinity: equal pictures have the PSNR null.
ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

double meanSquaredError(double psnr) {
  return std::isinf(psnr) ? 0.0 : 255.0 * 255.0 * std::pow(10.0, -psnr / 10.0);
}
double psnrOf(double squaredError) {
  return squaredError > 0.0 ? 10.0 * std::log10(255.0 * 255.0 / squaredError) : std::numeric_limits<double>::infinity();
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

/// Samples of one configuration by frame.
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
  for (const Sample* sample : samples) {
    if (!sample->error) continue;
    flips.push_back(sample->error->flip);
    squares.push_back(meanSquaredError(sample->error->psnr));
    similarities.push_back(sample->error->ssim);
  }
  if (flips.empty()) return nullptr;
  return {{"flip", {{"mean", meanOf(flips)}, {"largest", *std::max_element(flips.begin(), flips.end())}}},
          {"psnr",
           {{"mean", finite(psnrOf(meanOf(squares)))},
            {"least", finite(psnrOf(*std::max_element(squares.begin(), squares.end())))}}},
          {"ssim",
           {{"mean", meanOf(similarities)}, {"least", *std::min_element(similarities.begin(), similarities.end())}}}};
}

/// Level switches, and what they change. Temporal FLIP is that of the path where no frame is left out.
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
  for (const std::string& name : order)  // some passes do not run in every frame
    json[name] = spreadOf(times[name]).median * static_cast<double>(times[name].size()) /
                 static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  return json;
}

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
  json["triangles_total"] = [&] {
    std::uint64_t sum = 0;
    for (const Sample* sample : samples)
      sum += sample->statistics.triangles;
    return sum;
  }();
  json["triangles_ratio"] = toJson(spreadOf(ratios(samples, baseline, triangles)));
  json["frame_ms"] = spread(time);
  json["frame_ratio"] = toJson(spreadOf(ratios(samples, baseline, time)));
  json["passes_ms"] = passesJson(samples);
  json["draws"] = spread([](const Sample& s) { return s.statistics.draws; });
  json["drawn"] = spread([](const Sample& s) { return s.statistics.drawn; });
  json["culled_frustum"] = spread([](const Sample& s) { return s.statistics.culledFrustum; });
  json["culled_occlusion"] = spread([](const Sample& s) { return s.statistics.culledOcclusion; });
  std::vector<double> histogram;
  for (const Sample* sample : samples) {
    const std::vector<std::uint64_t>& levels = sample->statistics.lodHistogram;
    histogram.resize(std::max(histogram.size(), levels.size()));
    for (std::size_t k = 0; k < levels.size(); ++k)
      histogram[k] += static_cast<double>(levels[k]) / static_cast<double>(samples.size());
  }
  json["lod_histogram_mean"] = histogram;
  json["error"] = errorJson(samples);
  json["popping"] = poppingJson(results, samples, index);
  return json;
}

ordered_json pointJson(const CurvePoint& point) {
  return {{"tau", point.tau},   {"triangles", point.triangles}, {"frame_ms", point.frameMs},
          {"flip", point.flip}, {"psnr", finite(point.psnr)},   {"ssim", point.ssim}};
}

ordered_json sweepJson(const Results& results, const std::vector<Configuration>& configurations, const Plan& plan) {
  std::vector<std::vector<CurvePoint>> curves;
  std::vector<CurvePoint> all;
  std::vector<std::pair<std::size_t, std::size_t>> owners;
  for (std::size_t c = 0; c < configurations.size(); ++c) {
    curves.push_back(curveOf(results, c, plan.keptFrames().size()));
    for (std::size_t i = 0; i < curves.back().size(); ++i) {
      all.push_back(curves.back()[i]);
      owners.emplace_back(c, i);
    }
  }
  if (all.empty()) return nullptr;
  ordered_json json;
  json["curves"] = ordered_json::array();
  for (std::size_t c = 0; c < configurations.size(); ++c) {
    if (curves[c].empty()) continue;
    ordered_json points = ordered_json::array();
    for (const CurvePoint& point : curves[c])
      points.push_back(pointJson(point));
    json["curves"].push_back({{"name", configurations[c].name}, {"points", points}});
  }
  json["pareto"] = ordered_json::array();
  for (const std::size_t i : paretoFront(all))
    json["pareto"].push_back({{"name", configurations[owners[i].first].name},
                              {"tau", all[i].tau},
                              {"triangles", all[i].triangles},
                              {"flip", all[i].flip}});
  json["triangles_at_flip"] = ordered_json::array();
  for (const double budget : kFlipBudgets) {
    ordered_json row = {{"flip", budget}, {"triangles", ordered_json::object()}};
    for (std::size_t c = 0; c < configurations.size(); ++c) {
      if (curves[c].empty()) continue;
      const std::optional<double> triangles = trianglesAtFlip(curves[c], budget);
      row["triangles"][configurations[c].name] = triangles ? ordered_json(*triangles) : ordered_json(nullptr);
    }
    json["triangles_at_flip"].push_back(row);
  }
  // The same triangles: those of each point of the baseline, or of the first curve there is.
  std::size_t base = plan.baseline;
  while (curves[base].empty())
    base = (base + 1) % curves.size();
  json["flip_at_triangles"] = {{"of", configurations[base].name}, {"rows", ordered_json::array()}};
  for (const CurvePoint& point : curves[base]) {
    ordered_json row = {{"tau", point.tau}, {"triangles", point.triangles}, {"flip", ordered_json::object()}};
    for (std::size_t c = 0; c < configurations.size(); ++c) {
      if (curves[c].empty()) continue;
      const std::optional<double> flip = flipAtTriangles(curves[c], point.triangles);
      row["flip"][configurations[c].name] = flip ? ordered_json(*flip) : ordered_json(nullptr);
    }
    json["flip_at_triangles"]["rows"].push_back(row);
  }
  return json;
}

/// Logarithms, with room for errors of nothing.
double logOf(double value) {
  return std::log(std::max(value, 1e-9));
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  quoted += '"';
  return quoted;
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

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto lower = static_cast<std::size_t>(place);
    const std::size_t upper = std::min(lower + 1, values.size() - 1);
    return std::lerp(values[lower], values[upper], place - static_cast<double>(lower));
  };
  return {at(0.5), at(0.25), at(0.75)};
}

std::vector<CurvePoint> curveOf(const Results& results, std::size_t configuration, std::size_t keptFrames) {
  std::map<float, std::vector<const SweepSample*>> byTau;
  for (const SweepSample& sample : results.sweep)
    if (sample.configuration == configuration) byTau[sample.tau].push_back(&sample);
  std::vector<CurvePoint> curve;
  for (const auto& [tau, samples] : byTau) {
    if (samples.size() < keptFrames) continue;  // interrupted: means over fewer frames would not compare
    CurvePoint point{static_cast<double>(tau), 0.0, 0.0, 0.0, 0.0, 0.0};
    double squares = 0.0;
    const auto count = static_cast<double>(samples.size());
    for (const SweepSample* sample : samples) {
      point.triangles += static_cast<double>(sample->triangles) / count;
      point.frameMs += sample->frameMs / count;
      point.flip += sample->error.flip / count;
      point.ssim += sample->error.ssim / count;
      squares += meanSquaredError(sample->error.psnr) / count;
    }
    point.psnr = psnrOf(squares);
    curve.push_back(point);
  }
  std::stable_sort(curve.begin(), curve.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.triangles < b.triangles; });
  return curve;
}

std::optional<double> trianglesAtFlip(const std::vector<CurvePoint>& curve, double flip) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].flip > flip) continue;
    if (i == 0) return curve[0].triangles;
    const double from = logOf(curve[i - 1].flip);
    const double share = (from - logOf(flip)) / (from - logOf(curve[i].flip));
    return std::exp(std::lerp(logOf(curve[i - 1].triangles), logOf(curve[i].triangles), share));
  }
  return std::nullopt;
}

std::optional<double> flipAtTriangles(const std::vector<CurvePoint>& curve, double triangles) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].triangles < triangles) continue;
    if (curve[i].triangles <= triangles) return curve[i].flip;
    if (i == 0) return std::nullopt;
    const double from = logOf(curve[i - 1].triangles);
    const double share = (logOf(triangles) - from) / (logOf(curve[i].triangles) - from);
    return std::exp(std::lerp(logOf(curve[i - 1].flip), logOf(curve[i].flip), share));
  }
  return std::nullopt;
}

std::vector<std::size_t> paretoFront(const std::vector<CurvePoint>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a].triangles < points[b].triangles) return true;
    if (points[b].triangles < points[a].triangles) return false;
    return points[a].flip < points[b].flip;
  });
  std::vector<std::size_t> front;
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (points[i].flip >= best) continue;
    best = points[i].flip;
    front.push_back(i);
  }
  return front;
}

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
  json["width"] = plan.width;
  json["height"] = plan.height;
  json["frames"] = {{"first", plan.range.first},
                    {"last", plan.range.last},
                    {"step", plan.range.step},
                    {"count", plan.range.frames().size()},
                    {"lead", plan.range.step > 1 ? plan.lead : 0},
                    {"kept", plan.keptFrames()}};
  json["reference"] = references[static_cast<int>(plan.reference)];
  json["pixels_per_degree"] = plan.pixelsPerDegree;
  json["baseline"] = configurations[plan.baseline].name;
  json["triangles_full"] = results.samples.empty() ? 0 : results.samples.front().statistics.trianglesFull;
  json["objects"] = results.samples.empty() ? 0 : results.samples.front().statistics.objects;
  const std::vector<const Sample*> baseline = samplesOf(results, plan.baseline);
  json["configurations"] = ordered_json::array();
  for (std::size_t c = 0; c < configurations.size(); ++c)
    json["configurations"].push_back(configurationJson(results, configurations[c], c, baseline));
  json["sweep"] = sweepJson(results, configurations, plan);
  return json;
}

std::string framesCsv(const Results& results, const std::vector<Configuration>& configurations) {
  std::vector<std::string> passes;
  std::size_t levels = 0;
  for (const Sample& sample : results.samples) {
    levels = std::max(levels, sample.statistics.lodHistogram.size());
    for (const auto& [name, ms] : sample.passes)
      if (std::find(passes.begin(), passes.end(), name) == passes.end()) passes.push_back(name);
  }
  std::string text =
      "frame,configuration,triangles,draws,drawn,drawn_early,drawn_stale,culled_frustum,culled_occlusion,culled_small,"
      "occluders,switches,fading,dropped,visible,visible_switched,flip,psnr,ssim,temporal_flip,frame_ms";
  for (const std::string& pass : passes)
    text += "," + csvField(pass + " ms");
  for (std::size_t k = 0; k < levels; ++k)
    text += fmt::format(",level_{}", k);
  text += "\n";
  for (const Sample& sample : results.samples) {
    const render::FrameStatistics& s = sample.statistics;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},", sample.frame,
                        csvField(configurations[sample.configuration].name), s.triangles, s.draws, s.drawn,
                        s.drawnEarly, s.drawnStale, s.culledFrustum, s.culledOcclusion, s.culledSmall, s.occluders,
                        s.switches, s.fading, s.dropped);
    text += sample.visible ? fmt::format("{},", *sample.visible) : ",";
    if (sample.switched) text += fmt::format("{}", *sample.switched);
    text += sample.error
                ? fmt::format(",{:.6f},{:.4f},{:.6f}", sample.error->flip, sample.error->psnr, sample.error->ssim)
                : ",,,";
    text += sample.temporal ? fmt::format(",{:.6f}", *sample.temporal) : ",";
    text += fmt::format(",{:.3f}", sample.frameMs);
    for (const std::string& pass : passes) {
      double sum = 0.0;
      bool ran = false;
      for (const auto& [name, ms] : sample.passes) {
        if (name != pass) continue;
        sum += ms;
        ran = true;
      }
      text += ran ? fmt::format(",{:.3f}", sum) : ",";
    }
    for (std::size_t k = 0; k < levels; ++k)
      text += fmt::format(",{}", k < s.lodHistogram.size() ? s.lodHistogram[k] : 0);
    text += "\n";
  }
  return text;
}

std::string summaryText(const ordered_json& summary) {
  std::string text = fmt::format("{:<28} {:>10} {:>7} {:>10} {:>7} {:>8} {:>8} {:>8}\n", "configuration", "triangles",
                                 "ratio", "frame ms", "ratio", "FLIP", "PSNR", "switches");
  for (const ordered_json& c : summary.at("configurations")) {
    const ordered_json& error = c.at("error");
    const ordered_json none;
    text +=
        fmt::format("{:<28} {:>10} {:>7.2f} {:>10.1f} {:>7.2f} {:>8} {:>8} {:>8}\n", c.at("name").get<std::string>(),
                    shortCount(c.at("triangles").at("median")), c.at("triangles_ratio").at("median").get<double>(),
                    c.at("frame_ms").at("median").get<double>(), c.at("frame_ratio").at("median").get<double>(),
                    error.is_null() ? "-" : orDash(error.at("flip").at("mean"), "{:.4f}"),
                    error.is_null()                         ? "-"
                    : error.at("psnr").at("mean").is_null() ? "equal"
                                                            : orDash(error.at("psnr").at("mean"), "{:.2f}"),
                    orDash(c.at("popping").at("switches_per_visible_object"), "{:.4f}"));
  }
  return text;
}

}  // namespace jalousie::compare
