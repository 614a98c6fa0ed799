// Spreads, curves and Pareto fronts, and the files summary.json and frames.csv.
#include "compare/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/configuration.h"
#include "compare/curves.h"
#include "compare/frames_csv.h"
#include "compare/spread.h"
#include "core/random.h"
#include "scene/scene_names.h"

namespace jalousie::compare {
namespace {

using nlohmann::ordered_json;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Sample sampleOf(std::uint32_t frame, std::size_t configuration, std::uint64_t triangles, double frameMs) {
  Sample sample;
  sample.frame = frame;
  sample.configuration = configuration;
  sample.statistics.triangles = triangles;
  sample.statistics.trianglesFinest = 1000;
  sample.statistics.objects = 50;
  sample.frameMs = frameMs;
  return sample;
}

SweepSample sweepOf(std::size_t configuration, float tau, std::uint32_t frame, std::uint64_t triangles,
                    const ImageError& error) {
  return {configuration, tau, frame, triangles, 0.001 * static_cast<double>(triangles), error};
}

CurvePoint pointOf(double triangles, double flip) {
  CurvePoint point;
  point.triangles = triangles;
  point.flip = flip;
  return point;
}

std::vector<Configuration> configurationsOf(const std::vector<std::string>& names) {
  std::vector<Configuration> result;
  result.reserve(names.size());
  for (const std::string& name : names)
    result.push_back({name, "--as " + name, {}, {}});
  return result;
}

/// Frames 0 to 9, of which 0 and 9 are kept.
Plan planOf(Reference reference = Reference::kLod0) {
  Plan plan;
  plan.range = {0, 9, 1};
  plan.reference = reference;
  plan.keep = 2;
  return plan;
}

ordered_json summaryOf(const Results& results, const std::vector<std::string>& names, const Plan& plan = planOf()) {
  return summaryJson(results, configurationsOf(names), plan,
                     {"park.glb", "walk.glb", "a driver", "wall", "jalousie compare", "1.2.3"});
}

std::vector<std::string> keysOf(const ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items())
    keys.push_back(key);
  return keys;
}

using Keys = std::vector<std::string>;

/// Two configurations, ten frames, everything measured.
Results wholeResults() {
  Results results;
  for (std::uint32_t frame = 0; frame < 10; ++frame) {
    for (std::size_t c = 0; c < 2; ++c) {
      Sample sample = sampleOf(frame, c, 100 * (frame + 1) / (c + 1), 10.0 / static_cast<double>(c + 1));
      sample.statistics.draws = 7;
      sample.statistics.drawn = 30 + c;
      sample.statistics.culledFrustum = 4;
      sample.statistics.culledOcclusion = 5;
      sample.statistics.lodHistogram = {10, 20 + c};
      sample.passes = {{"cull", 1.0}, {"draw", 4.0}};
      sample.error = ImageError{40.0, 0.98, 0.02, 0.04, 1.0 + frame};
      sample.visible = 20;
      sample.switched = 3;
      results.samples.push_back(sample);
    }
  }
  for (const std::uint32_t frame : {0U, 9U}) {
    for (std::size_t c = 0; c < 2; ++c) {
      results.kept.push_back({frame, c, 0.01, 0.5, 0.003});
      for (const float tau : {1.0F, 2.0F})
        results.sweep.push_back(sweepOf(c, tau, frame, static_cast<std::uint64_t>(100.0F / tau),
                                        {40.0, 0.98, 0.02 * static_cast<double>(tau)}));
    }
  }
  results.complete = true;
  return results;
}

TEST(Spread, OfNothingIsZero) {
  const Spread spread = spreadOf({});
  EXPECT_EQ(spread.median, 0.0);
  EXPECT_EQ(spread.lower, 0.0);
  EXPECT_EQ(spread.upper, 0.0);
}

TEST(Spread, OfOneValueIsThatValue) {
  const Spread spread = spreadOf({3.5});
  EXPECT_EQ(spread.median, 3.5);
  EXPECT_EQ(spread.lower, 3.5);
  EXPECT_EQ(spread.upper, 3.5);
}

TEST(Spread, QuartilesOfFiveValuesAreAmongThem) {
  const Spread spread = spreadOf({5, 1, 4, 2, 3});
  EXPECT_EQ(spread.median, 3.0);
  EXPECT_EQ(spread.lower, 2.0);
  EXPECT_EQ(spread.upper, 4.0);
}

TEST(Spread, BetweenValuesPositionsAreWeighted) {
  const Spread two = spreadOf({10, 20});
  EXPECT_DOUBLE_EQ(two.median, 15.0);
  EXPECT_DOUBLE_EQ(two.lower, 12.5);
  EXPECT_DOUBLE_EQ(two.upper, 17.5);
  const Spread four = spreadOf({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(four.median, 2.5);
  EXPECT_DOUBLE_EQ(four.lower, 1.75);
  EXPECT_DOUBLE_EQ(four.upper, 3.25);
}

TEST(Spread, IsOrderedAndWithinTheValues) {
  Random random(3);
  for (std::size_t count = 1; count < 40; ++count) {
    std::vector<double> values(count);
    for (double& value : values)
      value = static_cast<double>(random.uniform(-5.0F, 5.0F));
    const Spread spread = spreadOf(values);
    EXPECT_LE(*std::min_element(values.begin(), values.end()), spread.lower);
    EXPECT_LE(spread.lower, spread.median);
    EXPECT_LE(spread.median, spread.upper);
    EXPECT_LE(spread.upper, *std::max_element(values.begin(), values.end()));
  }
}

TEST(Curve, PointsAreMeansOverTheKeptFrames) {
  Results results;
  results.sweep = {sweepOf(0, 1.0F, 3, 100, {40.0, 0.9, 0.01}), sweepOf(0, 1.0F, 7, 300, {40.0, 0.7, 0.03})};
  const std::vector<CurvePoint> curve = curveOf(results, 0, 2);
  ASSERT_EQ(curve.size(), 1U);
  EXPECT_EQ(curve[0].tau, 1.0);
  EXPECT_DOUBLE_EQ(curve[0].triangles, 200.0);
  EXPECT_DOUBLE_EQ(curve[0].frameMs, 0.2);
  EXPECT_DOUBLE_EQ(curve[0].flip, 0.02);
  EXPECT_DOUBLE_EQ(curve[0].ssim, 0.8);
  EXPECT_NEAR(curve[0].psnr, 40.0, 1e-9);
}

TEST(Curve, PsnrIsThatOfTheMeanSquaredError) {
  Results results;
  results.sweep = {sweepOf(0, 1.0F, 0, 1, {10.0, 1.0, 0.0}),       sweepOf(0, 1.0F, 1, 1, {30.0, 1.0, 0.0}),
                   sweepOf(1, 1.0F, 0, 1, {30.0, 1.0, 0.0}),       sweepOf(1, 1.0F, 1, 1, {kUnbounded, 1.0, 0.0}),
                   sweepOf(2, 1.0F, 0, 1, {kUnbounded, 1.0, 0.0}), sweepOf(2, 1.0F, 1, 1, {kUnbounded, 1.0, 0.0})};
  EXPECT_NEAR(curveOf(results, 0, 2).at(0).psnr, -10.0 * std::log10((0.1 + 0.001) / 2.0), 1e-9);
  EXPECT_NEAR(curveOf(results, 1, 2).at(0).psnr, 30.0 + 10.0 * std::log10(2.0), 1e-9);
  EXPECT_TRUE(std::isinf(curveOf(results, 2, 2).at(0).psnr));
}

TEST(Curve, LeavesOutTausThatSomeFrameLacks) {
  Results results;
  results.sweep = {sweepOf(0, 1.0F, 0, 90, {}), sweepOf(0, 2.0F, 0, 50, {}), sweepOf(0, 4.0F, 0, 20, {}),
                   sweepOf(0, 1.0F, 9, 80, {}), sweepOf(0, 2.0F, 9, 40, {})};
  const std::vector<CurvePoint> curve = curveOf(results, 0, 2);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0].tau, 2.0);
  EXPECT_EQ(curve[1].tau, 1.0);
}

TEST(Curve, AscendsByTrianglesWhateverTheOrderOfTheSweep) {
  Results results;
  for (const float tau : {8.0F, 1.0F, 4.0F, 0.5F, 2.0F})
    results.sweep.push_back(sweepOf(0, tau, 0, static_cast<std::uint64_t>(1000.0F / tau), {}));
  const std::vector<CurvePoint> curve = curveOf(results, 0, 1);
  ASSERT_EQ(curve.size(), 5U);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_GT(curve[i].triangles, curve[i - 1].triangles);
    EXPECT_LT(curve[i].tau, curve[i - 1].tau);
  }
}

TEST(Curve, HoldsOneConfigurationAlone) {
  Results results;
  results.sweep = {sweepOf(0, 1.0F, 0, 10, {}), sweepOf(1, 1.0F, 0, 20, {}), sweepOf(1, 2.0F, 0, 15, {})};
  EXPECT_EQ(curveOf(results, 0, 1).size(), 1U);
  EXPECT_EQ(curveOf(results, 1, 1).size(), 2U);
  EXPECT_TRUE(curveOf(results, 2, 1).empty());
}

TEST(TrianglesAtFlip, InterpolatesBetweenLogarithms) {
  const std::vector<CurvePoint> curve = {pointOf(100, 0.1), pointOf(10000, 0.001)};
  EXPECT_NEAR(trianglesAtFlip(curve, 0.01).value(), 1000.0, 1e-6);
  EXPECT_NEAR(trianglesAtFlip(curve, 0.001).value(), 10000.0, 1e-6);
}

TEST(TrianglesAtFlip, CoarsestPointServesWhereItIsGoodEnough) {
  const std::vector<CurvePoint> curve = {pointOf(100, 0.1), pointOf(10000, 0.001)};
  EXPECT_EQ(trianglesAtFlip(curve, 0.1), 100.0);
  EXPECT_EQ(trianglesAtFlip(curve, 0.9), 100.0);
}

TEST(TrianglesAtFlip, AbsentWhereTheCurveNeverGets) {
  EXPECT_FALSE(trianglesAtFlip({pointOf(100, 0.1), pointOf(10000, 0.001)}, 0.0009));
  EXPECT_FALSE(trianglesAtFlip({}, 0.5));
}

TEST(TrianglesAtFlip, ErrorsOfNothingAreReached) {
  const std::optional<double> triangles = trianglesAtFlip({pointOf(100, 0.1), pointOf(10000, 0.0)}, 0.001);
  ASSERT_TRUE(triangles);
  EXPECT_GT(*triangles, 100.0);
  EXPECT_LT(*triangles, 10000.0);
}

TEST(FlipAtTriangles, InterpolatesBetweenLogarithms) {
  const std::vector<CurvePoint> curve = {pointOf(100, 0.1), pointOf(10000, 0.001)};
  EXPECT_NEAR(flipAtTriangles(curve, 1000.0).value(), 0.01, 1e-9);
  EXPECT_EQ(flipAtTriangles(curve, 100.0), 0.1);
  EXPECT_EQ(flipAtTriangles(curve, 10000.0), 0.001);
}

TEST(FlipAtTriangles, AbsentOutsideTheCurve) {
  const std::vector<CurvePoint> curve = {pointOf(100, 0.1), pointOf(10000, 0.001)};
  EXPECT_FALSE(flipAtTriangles(curve, 99.0));
  EXPECT_FALSE(flipAtTriangles(curve, 10001.0));
  EXPECT_FALSE(flipAtTriangles({}, 1.0));
}

TEST(FlipAtTriangles, IsTheInverseOfTrianglesAtFlipAndFallsAlongACurveThatFalls) {
  Random random(11);
  std::vector<CurvePoint> curve;
  double triangles = 50.0;
  double flip = 0.5;
  for (int i = 0; i < 8; ++i) {
    curve.push_back(pointOf(triangles, flip));
    triangles *= static_cast<double>(random.uniform(1.1F, 3.0F));
    flip *= static_cast<double>(random.uniform(0.3F, 0.9F));
  }
  double lastFlip = kUnbounded;
  double lastTriangles = kUnbounded;
  for (double at = curve.front().triangles * 1.01; at < curve.back().triangles; at *= 1.07) {
    const std::optional<double> error = flipAtTriangles(curve, at);
    ASSERT_TRUE(error) << at;
    EXPECT_LT(*error, lastFlip);
    EXPECT_NEAR(trianglesAtFlip(curve, *error).value(), at, 1e-6 * at);
    lastFlip = *error;
  }
  for (double at = curve.back().flip * 1.01; at < 1.0; at *= 1.1) {
    const std::optional<double> cost = trianglesAtFlip(curve, at);
    ASSERT_TRUE(cost) << at;
    EXPECT_LE(*cost, lastTriangles);
    lastTriangles = *cost;
  }
}

TEST(ParetoFront, LeavesOutWhatAnotherPointBeats) {
  const std::vector<CurvePoint> points = {pointOf(300, 0.03), pointOf(100, 0.10), pointOf(200, 0.20),
                                          pointOf(200, 0.05), pointOf(400, 0.03)};
  EXPECT_EQ(paretoFront(points), (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ParetoFront, HasOneOfEqualPoints) {
  EXPECT_EQ(paretoFront({pointOf(100, 0.1), pointOf(100, 0.1), pointOf(100, 0.1)}), (std::vector<std::size_t>{0}));
}

TEST(ParetoFront, IsWhatNoPointDominates) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<CurvePoint> points;
    points.reserve(30);
    for (int i = 0; i < 30; ++i)
      points.push_back(pointOf(1.0 + random.below(12), 0.01 * random.below(12)));
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const bool asGood = points[k].triangles <= points[i].triangles && points[k].flip <= points[i].flip;
        const bool better = points[k].triangles < points[i].triangles || points[k].flip < points[i].flip;
        beaten = beaten || (asGood && (better || k < i));
      }
      if (!beaten) expected.push_back(i);
    }
    std::vector<std::size_t> front = paretoFront(points);
    for (std::size_t i = 1; i < front.size(); ++i)
      EXPECT_GT(points[front[i]].triangles, points[front[i - 1]].triangles);
    std::sort(front.begin(), front.end());
    EXPECT_EQ(front, expected);
  }
}

TEST(SummaryJson, KeysAreStable) {
  const ordered_json summary = summaryOf(wholeResults(), {"one", "two"});
  EXPECT_EQ(keysOf(summary), (Keys{"version", "complete", "scene", "path", "command", "renderer", "timing", "ignored",
                                   "width", "height", "frames", "reference", "pixels_per_degree", "baseline",
                                   "triangles_full", "objects", "configurations", "sweep"}));
  EXPECT_EQ(keysOf(summary["frames"]), (Keys{"first", "last", "step", "count", "lead", "kept"}));
  for (const ordered_json& c : summary["configurations"]) {
    EXPECT_EQ(keysOf(c), (Keys{"name",
                               "options",
                               "frames",
                               "triangles",
                               "triangles_total",
                               "triangles_ratio",
                               "frame_ms",
                               "frame_ratio",
                               "passes_ms",
                               "draws",
                               "drawn",
                               "visible",
                               "drawn_per_visible",
                               "queries",
                               "faces",
                               "culled_frustum",
                               "culled_occlusion",
                               "lod_histogram_mean",
                               "lost",
                               "error",
                               "popping",
                               "worst_objects"}));
    for (const char* spread : {"triangles", "triangles_ratio", "frame_ms", "frame_ratio", "draws", "drawn",
                               "culled_frustum", "culled_occlusion"})
      EXPECT_EQ(keysOf(c[spread]), (Keys{"median", "q1", "q3"})) << spread;
    EXPECT_EQ(keysOf(c["error"]), (Keys{"flip", "flip_covered", "psnr", "ssim", "butteraugli"}));
    EXPECT_EQ(keysOf(c["error"]["butteraugli"]), (Keys{"mean", "largest"}));
    EXPECT_EQ(keysOf(c["error"]["flip"]), (Keys{"mean", "largest"}));
    EXPECT_EQ(keysOf(c["error"]["psnr"]), (Keys{"mean", "least"}));
    EXPECT_EQ(keysOf(c["error"]["ssim"]), (Keys{"mean", "least"}));
    EXPECT_EQ(keysOf(c["popping"]),
              (Keys{"switches_per_visible_object", "frozen_flip_mean", "frozen_flip_largest", "temporal_flip"}));
  }
  const ordered_json& sweep = summary["sweep"];
  EXPECT_EQ(keysOf(sweep), (Keys{"curves", "pareto", "triangles_at_flip", "flip_at_triangles"}));
  EXPECT_EQ(keysOf(sweep["curves"][0]), (Keys{"name", "points"}));
  EXPECT_EQ(keysOf(sweep["curves"][0]["points"][0]),
            (Keys{"tau", "triangles", "frame_ms", "flip", "psnr", "ssim", "butteraugli"}));
  EXPECT_EQ(keysOf(sweep["pareto"][0]), (Keys{"name", "tau", "triangles", "flip"}));
  EXPECT_EQ(keysOf(sweep["triangles_at_flip"][0]), (Keys{"flip", "triangles"}));
  EXPECT_EQ(keysOf(sweep["flip_at_triangles"]), (Keys{"of", "rows"}));
  EXPECT_EQ(keysOf(sweep["flip_at_triangles"]["rows"][0]), (Keys{"tau", "triangles", "flip"}));
}

TEST(SummaryJson, HasTheCountsOfTechniquesThatWereUsed) {
  Results results = wholeResults();
  for (Sample& sample : results.samples) {
    if (sample.configuration == 0) continue;
    sample.statistics.facesTested = 80;
    sample.statistics.facesCulled = 30;
  }
  const ordered_json summary = summaryOf(results, {"one", "two"});
  EXPECT_TRUE(summary["configurations"][0]["faces"].is_null());
  EXPECT_TRUE(summary["configurations"][1]["queries"].is_null());
  const ordered_json& faces = summary["configurations"][1]["faces"];
  EXPECT_EQ(keysOf(faces), (Keys{"faces_tested", "faces_culled", "faces_whole"}));
  EXPECT_EQ(faces["faces_tested"]["median"], 80);
  EXPECT_EQ(faces["faces_culled"]["median"], 30);
  EXPECT_EQ(faces["faces_whole"]["median"], 0);
}

TEST(SummaryJson, SaysWhatWasMeasuredAndWhere) {
  const ordered_json summary = summaryOf(wholeResults(), {"one", "two"});
  EXPECT_EQ(summary["version"], "1.2.3");
  EXPECT_EQ(summary["scene"], "park.glb");
  EXPECT_EQ(summary["path"], "walk.glb");
  EXPECT_EQ(summary["renderer"], "a driver");
  EXPECT_EQ(summary["timing"], "wall");
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["reference"], "lod0");
  EXPECT_EQ(summary["baseline"], "one");
  EXPECT_EQ(summary["triangles_full"], 1000);
  EXPECT_EQ(summary["objects"], 50);
  EXPECT_EQ(summary["frames"]["count"], 10);
  EXPECT_EQ(summary["frames"]["kept"], (std::vector<int>{0, 9}));
  EXPECT_EQ(summary["configurations"][1]["name"], "two");
  EXPECT_EQ(summary["configurations"][1]["options"], "--as two");
  EXPECT_EQ(summary["configurations"][0]["triangles_total"], 5500);
  EXPECT_EQ(summary["configurations"][0]["lod_histogram_mean"], (std::vector<double>{10, 20}));
}

TEST(SummaryJson, NamesLeadAndCount) {
  Plan plan = planOf();
  plan.lead = 5;
  EXPECT_EQ(summaryOf({}, {"one"}, plan)["frames"]["lead"], 5);
  plan.range.step = 3;
  EXPECT_EQ(summaryOf({}, {"one"}, plan)["frames"]["lead"], 5);
  EXPECT_EQ(summaryOf({}, {"one"}, plan)["frames"]["count"], 4);
}

TEST(SummaryJson, ButteraugliIsAMeanAndALargestFrameOrNull) {
  Results results = wholeResults();
  for (SweepSample& sample : results.sweep)
    sample.error.butteraugli = 1.5 * static_cast<double>(sample.tau) + sample.frame;
  const ordered_json summary = summaryOf(results, {"one", "two"});
  EXPECT_DOUBLE_EQ(summary["configurations"][1]["error"]["butteraugli"]["mean"].get<double>(), 5.5);
  EXPECT_EQ(summary["configurations"][1]["error"]["butteraugli"]["largest"], 10.0);
  EXPECT_DOUBLE_EQ(summary["sweep"]["curves"][0]["points"][0]["butteraugli"].get<double>(), 3.0 + 4.5) << "tau 2";
  EXPECT_NE(summaryText(summary).find("Butteraugli"), std::string::npos);
  EXPECT_NE(summaryText(summary).find("5.5000"), std::string::npos);
  for (Sample& sample : results.samples)
    sample.error->butteraugli.reset();
  for (SweepSample& sample : results.sweep)
    sample.error.butteraugli.reset();
  const ordered_json without = summaryOf(results, {"one", "two"});
  EXPECT_TRUE(without["configurations"][0]["error"]["butteraugli"].is_null());
  EXPECT_TRUE(without["sweep"]["curves"][0]["points"][0]["butteraugli"].is_null());
  EXPECT_EQ(summaryText(without).find("Butteraugli"), std::string::npos);
}

TEST(SummaryJson, PsnrOfEqualPicturesIsNull) {
  Results results = wholeResults();
  for (Sample& sample : results.samples)
    if (sample.configuration == 0 || sample.frame > 0) sample.error = ImageError{kUnbounded, 1.0, 0.0};
  for (SweepSample& sample : results.sweep)
    if (sample.configuration == 0) sample.error = {kUnbounded, 1.0, 0.0};
  const ordered_json summary = summaryOf(results, {"one", "two"});
  const ordered_json& equal = summary["configurations"][0]["error"]["psnr"];
  EXPECT_TRUE(equal["mean"].is_null());
  EXPECT_TRUE(equal["least"].is_null());
  // One frame of ten that differs: a tenth of its squared error.
  const ordered_json& nearly = summary["configurations"][1]["error"]["psnr"];
  EXPECT_NEAR(nearly["mean"].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(nearly["least"].get<double>(), 40.0, 1e-9);
  EXPECT_TRUE(summary["sweep"]["curves"][0]["points"][0]["psnr"].is_null());
  EXPECT_EQ(ordered_json::parse(summary.dump()), summary) << "what is written is what was meant";
}

TEST(SummaryJson, RatiosAreThoseOfTheSameFrame) {
  Results results;
  const std::uint64_t base[] = {100, 200, 400};
  const std::uint64_t other[] = {300, 100, 200};  // three times, half, half; the medians are equal
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    results.samples.push_back(sampleOf(frame, 0, other[frame], 4.0));
    results.samples.push_back(sampleOf(frame, 1, base[frame], 2.0));
  }
  Plan plan = planOf();
  plan.baseline = 1;
  const ordered_json summary = summaryOf(results, {"other", "base"}, plan);
  const ordered_json& ratio = summary["configurations"][0]["triangles_ratio"];
  EXPECT_DOUBLE_EQ(ratio["median"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(ratio["q3"].get<double>(), 1.75);
  EXPECT_DOUBLE_EQ(summary["configurations"][0]["frame_ratio"]["median"].get<double>(), 2.0);
  for (const char* key : {"triangles_ratio", "frame_ratio"})
    EXPECT_EQ(summary["configurations"][1][key]["median"], 1.0) << "the baseline against itself";
}

TEST(SummaryJson, FramesWhereTheBaselineDrawsNothingHaveNoRatio) {
  Results results;
  results.samples = {sampleOf(0, 0, 0, 1.0), sampleOf(0, 1, 70, 1.0), sampleOf(1, 0, 100, 1.0),
                     sampleOf(1, 1, 300, 1.0)};
  EXPECT_EQ(summaryOf(results, {"base", "other"})["configurations"][1]["triangles_ratio"]["median"], 3.0);
}

TEST(SummaryJson, SwitchesAreCountedPerVisibleObject) {
  Results results = wholeResults();
  for (Sample& sample : results.samples) {
    sample.visible = sample.frame == 0 ? 90 : 10;
    sample.switched = sample.frame == 0 ? 0 : 2;
  }
  const ordered_json summary = summaryOf(results, {"one", "two"});
  EXPECT_DOUBLE_EQ(summary["configurations"][0]["popping"]["switches_per_visible_object"].get<double>(), 18.0 / 180.0);
}

TEST(SummaryJson, FrozenFlipHasItsMeanAndTheLargestPixelOfAllKeptFrames) {
  Results results = wholeResults();
  results.kept = {{0, 0, 0.01, 0.5, 0.002}, {0, 1, 0.5, 0.9, 0.5}, {9, 0, 0.03, 0.2, 0.004}};
  const ordered_json popping = summaryOf(results, {"one", "two"})["configurations"][0]["popping"];
  EXPECT_DOUBLE_EQ(popping["frozen_flip_mean"].get<double>(), 0.02);
  EXPECT_DOUBLE_EQ(popping["frozen_flip_largest"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(popping["temporal_flip"].get<double>(), 0.003);
}

TEST(SummaryJson, TemporalFlipIsThatOfThePathWhereThePathHasIt) {
  Results results = wholeResults();
  results.kept = {{0, 0, 0.01, 0.5, 0.5}};
  double sum = 0.0;
  double count = 0.0;
  for (Sample& sample : results.samples) {
    if (sample.configuration != 0 || sample.frame == 0) continue;
    sample.temporal = 0.001 * (1.0 + count);
    sum += *sample.temporal;
    count += 1.0;
  }
  const ordered_json popping = summaryOf(results, {"one", "two"})["configurations"][0]["popping"];
  EXPECT_DOUBLE_EQ(popping["temporal_flip"].get<double>(), sum / count);
}

TEST(SummaryJson, PassThatRunsInHalfOfTheFramesCostsHalf) {
  Results results;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    results.samples.push_back(sampleOf(frame, 0, 1, 1.0));
    results.samples.back().passes = {{"draw", 3.0}};
    if (frame % 2 == 1) results.samples.back().passes.emplace_back("count pixels", 8.0);
  }
  const ordered_json passes = summaryOf(results, {"one"})["configurations"][0]["passes_ms"];
  EXPECT_EQ(keysOf(passes), (Keys{"draw", "count pixels"}));
  EXPECT_DOUBLE_EQ(passes["draw"].get<double>(), 3.0);
  EXPECT_DOUBLE_EQ(passes["count pixels"].get<double>(), 4.0);
}

TEST(SummaryJson, SweepNamesTheFrontAndTheCostAtEqualError) {
  const ordered_json sweep = summaryOf(wholeResults(), {"one", "two"})["sweep"];
  ASSERT_EQ(sweep["curves"].size(), 2U);
  EXPECT_EQ(sweep["curves"][1]["name"], "two");
  EXPECT_EQ(sweep["curves"][1]["points"].size(), 2U);
  EXPECT_EQ(sweep["pareto"].size(), 2U) << "both curves are equal";
  // FLIP 0.04 with 50 triangles, 0.02 with 100.
  ASSERT_EQ(sweep["triangles_at_flip"].size(), 3U);
  EXPECT_TRUE(sweep["triangles_at_flip"][0]["triangles"]["one"].is_null()) << "0.01 is out of reach";
  EXPECT_NEAR(sweep["triangles_at_flip"][1]["triangles"]["one"].get<double>(), 100.0, 1e-6);
  EXPECT_NEAR(sweep["triangles_at_flip"][2]["triangles"]["two"].get<double>(), 50.0, 1e-6);
  EXPECT_EQ(sweep["flip_at_triangles"]["of"], "one");
  for (const ordered_json& row : sweep["flip_at_triangles"]["rows"])
    EXPECT_EQ(row["flip"]["one"], row["flip"]["two"]);
}

TEST(SummaryJson, ObjectsAreNamedAndNullWhereNothingIsKnown) {
  Results results = wholeResults();
  results.objects = {{9,
                      1,
                      40,
                      8.0,
                      0.5,
                      {{2, 0, true, 1, 0, 300, 25, 1.0, 0.5, 6.0, OtherLevel{700, 0.25}},
                       {0, 0, false, 0, 0, 0, 0, {}, {}, 1.5, {}},
                       {1, 1, true, 3, 5, 50, 4, {}, {}, 0.0, {}}}}};
  scene::SceneNames names;
  names.nodes = {"door", ""};
  names.nodeOf = {1, 7, 0};
  names.meshes = {"panel", ""};
  const ordered_json summary =
      summaryJson(results, configurationsOf({"one", "two"}), planOf(), {"a", "b", "c", "d", "e", "f", {}, &names});
  EXPECT_TRUE(summary["configurations"][0]["worst_objects"].is_null());
  const ordered_json& objects = summary["configurations"][1]["worst_objects"];
  EXPECT_EQ(objects["frame"], 9);
  EXPECT_EQ(objects["count"], 40);
  EXPECT_EQ(objects["flip"], 8.0);
  EXPECT_EQ(objects["flip_of_background"], 0.5);
  ASSERT_EQ(objects["rows"].size(), 3U);
  const ordered_json& door = objects["rows"][0];
  EXPECT_EQ(door, ordered_json::parse(R"({"object": 2, "name": "door", "mesh": "panel", "level": 1,
      "tessellation": null, "triangles": 300, "pixels": 25, "error_allowed_px": 1.0, "error_px": 0.5, "flip": 6.0,
      "finer": {"triangles": 700, "error_px": 0.25}})"));
  const ordered_json& lost = objects["rows"][1];
  EXPECT_EQ(lost["name"], "panel") << "a node without a name is known by its mesh";
  for (const char* key : {"level", "triangles", "error_allowed_px", "error_px", "finer", "tessellation"})
    EXPECT_TRUE(lost[key].is_null()) << key;
  EXPECT_EQ(objects["rows"][2]["name"], "object 1");
  EXPECT_EQ(objects["rows"][2]["tessellation"], 5);
}

TEST(SummaryJson, InterruptedExperimentSaysWhatItHas) {
  const std::vector<std::string> names = {"one", "two"};
  Results results = wholeResults();
  results.complete = false;
  results.sweep.clear();
  results.kept.clear();
  results.samples.resize(6);  // three frames
  const ordered_json summary = summaryOf(results, names);
  EXPECT_EQ(summary["complete"], false);
  EXPECT_TRUE(summary["sweep"].is_null());
  EXPECT_EQ(summary["frames"]["count"], 10);
  for (const ordered_json& c : summary["configurations"]) {
    EXPECT_EQ(c["frames"], 3);
    EXPECT_FALSE(c["error"].is_null());
    EXPECT_TRUE(c["popping"]["frozen_flip_mean"].is_null());
    EXPECT_TRUE(c["popping"]["frozen_flip_largest"].is_null());
    EXPECT_TRUE(c["popping"]["temporal_flip"].is_null());
  }
  // The sweep has come to the second kept frame's first tau.
  results = wholeResults();
  results.sweep.clear();
  for (const auto& [frame, tau] : {std::pair{0U, 1.0F}, {0U, 2.0F}, {9U, 1.0F}})
    for (std::size_t c = 0; c < 2; ++c)
      results.sweep.push_back(sweepOf(c, tau, frame, 100, {40.0, 0.9, 0.02}));
  const ordered_json curves = summaryOf(results, names)["sweep"]["curves"];
  EXPECT_EQ(curves.size(), 2U);
  for (const ordered_json& curve : curves)
    EXPECT_EQ(curve["points"].size(), 1U);
}

TEST(SummaryJson, ExperimentWithoutAStepHasEveryKey) {
  const ordered_json summary = summaryOf({}, {"one", "two"});
  const ordered_json whole = summaryOf(wholeResults(), {"one", "two"});
  EXPECT_EQ(keysOf(summary), keysOf(whole));
  EXPECT_EQ(keysOf(summary["configurations"][0]), keysOf(whole["configurations"][0]));
  EXPECT_EQ(summary["complete"], false);
  EXPECT_EQ(summary["configurations"][0]["frames"], 0);
  EXPECT_TRUE(summary["configurations"][0]["error"].is_null());
  EXPECT_TRUE(summary["sweep"].is_null());
}

TEST(SummaryJson, WithoutPicturesThereIsNoError) {
  Results results = wholeResults();
  results.kept.clear();
  results.sweep.clear();
  for (Sample& sample : results.samples) {
    sample.error.reset();
    sample.visible.reset();
    sample.switched.reset();
  }
  const ordered_json summary = summaryOf(results, {"one", "two"}, planOf(Reference::kNone));
  EXPECT_EQ(summary["reference"], "none");
  EXPECT_TRUE(summary["frames"]["kept"].empty());
  EXPECT_TRUE(summary["sweep"].is_null());
  for (const ordered_json& c : summary["configurations"]) {
    EXPECT_EQ(c["frames"], 10);
    EXPECT_GT(c["triangles"]["median"].get<double>(), 0.0);
    EXPECT_TRUE(c["error"].is_null());
    for (const auto& [key, value] : c["popping"].items())
      EXPECT_TRUE(value.is_null()) << key;
  }
}

/// Lines and fields of a CSV text (RFC 4180).
std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines = {{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& field = lines.back().back();
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      field += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      lines.back().emplace_back();
    } else if (!quoted && c == '\n') {
      lines.push_back({""});
    } else {
      field += c;
    }
  }
  EXPECT_FALSE(quoted);
  EXPECT_EQ(lines.back(), std::vector<std::string>{""}) << "ends with a line's end";
  lines.pop_back();
  return lines;
}

/// The field of a line under a header.
std::string field(const std::vector<std::vector<std::string>>& lines, std::size_t line, const std::string& header) {
  const auto at = std::find(lines.at(0).begin(), lines.at(0).end(), header);
  if (at == lines.at(0).end()) return "no column " + header;
  return lines.at(line).at(static_cast<std::size_t>(at - lines.at(0).begin()));
}

TEST(FramesCsv, HasAHeaderAndALinePerSample) {
  const std::vector<std::vector<std::string>> lines =
      parseCsv(framesCsv(wholeResults(), configurationsOf({"one", "two"})));
  ASSERT_EQ(lines.size(), 21U);
  EXPECT_EQ(lines[0][0], "frame");
  EXPECT_EQ(field(lines, 1, "configuration"), "one");
  EXPECT_EQ(field(lines, 2, "configuration"), "two");
  EXPECT_EQ(field(lines, 20, "frame"), "9");
  EXPECT_EQ(field(lines, 20, "triangles"), "500");
  EXPECT_EQ(field(lines, 20, "level_1"), "21");
  EXPECT_EQ(std::stod(field(lines, 20, "draw ms")), 4.0);
  EXPECT_EQ(std::stod(field(lines, 20, "frame_ms")), 5.0);
  EXPECT_EQ(std::stod(field(lines, 20, "flip")), 0.02);
  EXPECT_EQ(std::stod(field(lines, 20, "psnr")), 40.0);
  EXPECT_EQ(std::stod(field(lines, 20, "butteraugli")), 10.0);
  EXPECT_EQ(field(lines, 20, "visible_switched"), "3");
}

TEST(FramesCsv, WithoutSamplesIsAHeader) {
  EXPECT_EQ(parseCsv(framesCsv({}, configurationsOf({"one"}))).size(), 1U);
}

TEST(FramesCsv, EveryLineHasTheSameColumns) {
  Results results = wholeResults();
  results.samples[1].error.reset();
  results.samples[2].visible.reset();
  results.samples[2].switched.reset();
  results.samples[3].passes.clear();
  results.samples[4].passes.emplace_back("late, \"pass\"", 1.0);
  results.samples[5].statistics.lodHistogram = {1, 2, 3, 4, 5};
  results.samples[6].statistics.lodHistogram.clear();
  const std::vector<std::vector<std::string>> lines = parseCsv(framesCsv(results, configurationsOf({"one", "two"})));
  for (const std::vector<std::string>& line : lines)
    EXPECT_EQ(line.size(), lines[0].size()) << line[0];
  EXPECT_EQ(field(lines, 2, "flip"), "");
  EXPECT_EQ(field(lines, 2, "ssim"), "");
  EXPECT_EQ(field(lines, 2, "butteraugli"), "");
  EXPECT_EQ(field(lines, 3, "visible"), "");
  EXPECT_EQ(field(lines, 4, "draw ms"), "") << "did not run";
  EXPECT_EQ(std::stod(field(lines, 5, "late, \"pass\" ms")), 1.0);
  EXPECT_EQ(field(lines, 6, "level_4"), "5");
  EXPECT_EQ(field(lines, 7, "level_0"), "0");
}

TEST(FramesCsv, NamesMayHoldCommasQuotesAndLineEnds) {
  const std::vector<std::string> names = {"a, b", "the \"best\"", ",\"", "two\nlines", "plain"};
  Results results;
  for (std::size_t c = 0; c < names.size(); ++c)
    results.samples.push_back(sampleOf(0, c, 1, 1.0));
  const std::vector<std::vector<std::string>> lines = parseCsv(framesCsv(results, configurationsOf(names)));
  ASSERT_EQ(lines.size(), names.size() + 1);
  for (std::size_t c = 0; c < names.size(); ++c) {
    EXPECT_EQ(field(lines, c + 1, "configuration"), names[c]);
    EXPECT_EQ(lines[c + 1].size(), lines[0].size());
  }
}

TEST(FramesCsv, PassThatRunsTwiceInAFrameIsOneColumn) {
  Results results;
  results.samples = {sampleOf(0, 0, 1, 1.0)};
  results.samples[0].passes = {{"draw", 1.5}, {"cull", 0.5}, {"draw", 2.0}};
  const std::vector<std::vector<std::string>> lines = parseCsv(framesCsv(results, configurationsOf({"one"})));
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), "draw ms"), 1);
  EXPECT_EQ(std::stod(field(lines, 1, "draw ms")), 3.5);
}

TEST(SummaryText, NamesEveryConfiguration) {
  const std::vector<std::string> names = {"one", "a name that is longer than the column of names has room for"};
  for (const Results& results : {wholeResults(), Results()}) {
    const std::string text = summaryText(summaryOf(results, names));
    for (const std::string& name : names)
      EXPECT_NE(text.find(name), std::string::npos) << name;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << "a header, and a line each";
  }
}

TEST(SummaryText, EqualPicturesAreCalledEqual) {
  Results results = wholeResults();
  for (Sample& sample : results.samples)
    sample.error = ImageError{kUnbounded, 1.0, 0.0};
  EXPECT_NE(summaryText(summaryOf(results, {"one", "two"})).find("equal"), std::string::npos);
  EXPECT_EQ(summaryText(summaryOf(wholeResults(), {"one", "two"})).find("equal"), std::string::npos);
}

}  // namespace
}  // namespace jalousie::compare
