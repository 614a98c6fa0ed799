// Tolerable error behind a sieve and behind a window, at the same visible share, as several judges see it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/butteraugli.h"
#include "compare/curves.h"
#include "compare/image_error.h"
#include "core/error.h"
#include "gl_bench.h"
#include "lv_setup.h"
#include "lv_sweep.h"
#include "lv_times.h"
#include "shared/limits.h"

namespace jalousie::bench {
namespace {

constexpr std::uint32_t kSide = 256;                                                  // of the pictures, pixels
constexpr std::array<std::uint32_t, 8> kHoles = {1, 2, 4, 8, 16, 32, 64, kSide / 2};  // the last one is the window
constexpr std::array<std::uint8_t, 3> kOccluderGreys = {32, 96, 224};
constexpr double kLeastError = 0.2;  // pixels; levels with smaller and larger errors are not used
constexpr double kMostError = 40.0;

/// A level of the object, and its picture.
struct Level {
  double error;  ///< pixels
  ImageRgba8 picture;
};

constexpr std::size_t kJudges = 4;
constexpr std::array<const char*, kJudges> kJudgeNames = {"PSNR", "FLIP", "SSIM", "Butteraugli"};
/// What each judge says of a difference; larger is worse: squared error, mean FLIP, 1 - SSIM, Butteraugli's 3-norm.
using Scores = std::array<double, kJudges>;

/// A picture behind an occluder with square holes. Holes and bars have the same width, so that a quarter is open, and
/// the four quarters together show every pixel once.
ImageRgba8 behindHoles(ImageRgba8 picture, std::uint32_t hole, std::uint32_t quarter, std::uint8_t grey) {
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      if (x / hole % 2 == quarter % 2 && y / hole % 2 == quarter / 2) continue;
      for (std::size_t c = 0; c < 3; ++c)
        picture.pixels[picture.offset(x, y) + c] = grey;
    }
  }
  return picture;
}

/// Means over the four quarters.
Scores judge(const ImageRgba8& reference, const ImageRgba8& test, std::uint32_t hole, std::uint8_t grey) {
  Scores scores{};
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    const ImageRgba8 a = behindHoles(reference, hole, quarter, grey);
    const ImageRgba8 b = behindHoles(test, hole, quarter, grey);
    scores[0] += compare::meanSquaredError(compare::psnr(a, b)) / 4.0;
    scores[1] += compare::mean(compare::flipMap(compare::FlipImage(a), compare::FlipImage(b))) / 4.0;
    scores[2] += (1.0 - compare::ssim(a, b)) / 4.0;
    scores[3] += compare::butteraugli(a, b).mean / 4.0;
  }
  return scores;
}

/// The object's levels whose errors lie in the range, finest first. Errors: kUsage if there are fewer than three.
std::vector<Level> levelsOf(const LvView& view, render::FrameRenderer& renderer, const scene::Camera& camera) {
  const gpu::Chain& chain = view.scene.chains[view.scene.objects[0].chain];
  const double pixelsPerUnit = static_cast<double>(renderer.readObject(0).box.pixelsPerUnit);
  std::vector<Level> levels;
  for (std::uint32_t k = 1; k < chain.lodCount; ++k) {
    const double error = static_cast<double>(view.scene.lods[chain.firstLod + k].errorObject) * pixelsPerUnit;
    if (!(error >= kLeastError && error <= kMostError)) continue;
    const LvConfiguration exact = {"", CullMode::kFrustum, LodRule::kPixelError, LvMeasure::kNone};
    levels.push_back({error, settledImage(renderer, optionsOf(exact, static_cast<float>(error * 1.0001)), camera)});
    require(renderer.readObject(0).state.lod == k, fmt::format("level {} was not drawn at its own error", k));
  }
  if (levels.size() < 3) {
    throw Error(ErrorCode::kUsage,
                fmt::format("the object has {} levels with an error of {} to {} pixels in this view; 3 are needed",
                            levels.size(), kLeastError, kMostError),
                view.text);
  }
  return levels;
}

/// Error at which a judge gives a score, from its scores of the levels: interpolated linearly between logarithms; NaN
/// outside their range.
double errorAt(const std::vector<Level>& levels, const std::vector<Scores>& scores, std::size_t judge, double score) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double from = std::log(scores[k - 1][judge]);
    const double to = std::log(scores[k][judge]);
    const double at = (std::log(score) - from) / (to - from);
    if (!(at >= 0.0 && at <= 1.0)) continue;
    return std::exp(std::lerp(std::log(levels[k - 1].error), std::log(levels[k].error), at));
  }
  return std::nan("");
}

/// Tolerable error over that of the window: the geometric mean over the levels whose score behind the window is within
/// the range of the scores.
double ratioToWindow(const std::vector<Level>& levels, const std::vector<Scores>& scores,
                     const std::vector<Scores>& window, std::size_t judge) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double error = errorAt(levels, scores, judge, window[k][judge]);
    if (std::isnan(error)) continue;
    sum += std::log(error / levels[k].error);
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : std::nan("");
}

/// What --masking divides the error by. The mean chord of square holes is their side.
double maskingOf(std::uint32_t hole) {
  const auto most = static_cast<double>(gpu::kMaskingPixels);
  return std::pow(most / std::min(static_cast<double>(hole), most), static_cast<double>(gpu::kMaskingExponent));
}

/// One row of the table: ratios to the window behind one occluder.
void addRow(const LvView& view, std::uint32_t hole, std::uint8_t grey, const std::array<double, kJudges>& ratios,
            nlohmann::ordered_json& figures) {
  nlohmann::ordered_json row = {{"scene", view.sceneName}, {"view", view.text}, {"grey", grey}, {"hole", hole}};
  fmt::print("| {} | {} |", grey, hole);
  for (std::size_t j = 0; j < kJudges; ++j) {
    fmt::print(" {:.2f} |", ratios[j]);
    row[kJudgeNames[j]] = std::isnan(ratios[j]) ? nlohmann::ordered_json() : nlohmann::ordered_json(ratios[j]);
  }
  fmt::print(" {:.2f} |\n", maskingOf(hole));
  std::fflush(stdout);
  figures.push_back(row);
}

/// Rows for one occluder, one per size of the holes.
void judgeOccluder(const LvView& view, const ImageRgba8& reference, const std::vector<Level>& levels, std::uint8_t grey,
                   nlohmann::ordered_json& figures) {
  std::vector<std::vector<Scores>> scores;  // [holes][levels]
  for (const std::uint32_t hole : kHoles)
    for (std::vector<Scores>& row = scores.emplace_back(); const Level& level : levels)
      row.push_back(judge(reference, level.picture, hole, grey));
  for (std::size_t h = 0; h < kHoles.size(); ++h) {
    std::array<double, kJudges> ratios{};
    for (std::size_t j = 0; j < kJudges; ++j)
      ratios[j] = ratioToWindow(levels, scores[h], scores.back(), j);
    require(std::abs(ratios[0] - 1.0) < 1e-9, "the squared error depends on the holes");
    addRow(view, kHoles[h], grey, ratios, figures);
  }
}

void printHead() {
  fmt::print("| grey of the occluder | holes, pixels |");
  for (const char* name : kJudgeNames)
    fmt::print(" {} |", name);
  fmt::print(" --masking |\n|---|---|---|---|---|---|---|\n");
}

/// The rows of one judge and one size of the holes.
std::vector<double> ratiosOf(const nlohmann::ordered_json& figures, std::uint32_t hole, const char* judge) {
  std::vector<double> ratios;
  for (const nlohmann::ordered_json& row : figures)
    if (row["hole"] == hole && !row[judge].is_null()) ratios.push_back(row[judge]);
  return ratios;
}

/// Exponent p with the least squares of log(ratio) - p log(64 / hole), over all rows with holes below 64 pixels.
double fittedExponent(const nlohmann::ordered_json& figures, const char* judge) {
  double products = 0.0;
  double squares = 0.0;
  for (const std::uint32_t hole : kHoles) {
    const double finer = std::max(std::log(static_cast<double>(gpu::kMaskingPixels) / hole), 0.0);
    for (const double ratio : ratiosOf(figures, hole, judge)) {
      products += finer * std::log(ratio);
      squares += finer * finer;
    }
  }
  return products / squares;
}

}  // namespace

void measureMasking(const LvView& view, nlohmann::ordered_json& figures) {
  if (view.scene.objects.size() != 1)
    throw Error(ErrorCode::kUsage, "masking measures a scene of one object", view.sceneName);
  render::FrameRenderer renderer(view.scene, kSide, kSide);
  const scene::Camera camera = view.camera();
  const ImageRgba8 reference = settledImage(renderer, finestOptions(/*twoPhases=*/false), camera);
  const std::vector<Level> levels = levelsOf(view, renderer, camera);
  fmt::print("{}, view {}: errors of {:.2f} to {:.1f} pixels in {} levels\n", view.sceneName, view.text,
             levels.front().error, levels.back().error, levels.size());
  printHead();
  for (const std::uint8_t grey : kOccluderGreys)
    judgeOccluder(view, reference, levels, grey, figures);
}

void printMasking(const nlohmann::ordered_json& figures) {
  fmt::print("Least to largest ratio over all views and occluders\n");
  printHead();
  for (const std::uint32_t hole : kHoles) {
    fmt::print("| all | {} |", hole);
    for (const char* name : kJudgeNames) {
      const std::vector<double> ratios = ratiosOf(figures, hole, name);
      if (ratios.empty()) throw Error(ErrorCode::kUsage, "no level is within the range of the scores", name);
      const auto [least, largest] = std::minmax_element(ratios.begin(), ratios.end());
      fmt::print(" {:.2f} to {:.2f} |", *least, *largest);
    }
    fmt::print(" {:.2f} |\n", maskingOf(hole));
  }
  fmt::print("| all | exponent |");
  for (const char* name : kJudgeNames)
    fmt::print(" {:.2f} |", fittedExponent(figures, name));
  fmt::print(" {:.2f} |\n", static_cast<double>(gpu::kMaskingExponent));
}

void measureMaskingCost(const LvView& view, nlohmann::ordered_json& figures) {
  constexpr int kRounds = 7;
  render::FrameRenderer renderer(view.scene, kLvWidth, kLvHeight);
  const scene::Camera camera = view.camera();
  fmt::print("{}, view {}\n| configuration | triangles | frame | analysis |\n|---|---|---|---|\n", view.sceneName,
             view.text);
  for (const LvConfiguration& configuration : {kUniform, kRelaxed, kDefault}) {
    std::vector<render::FrameOptions> both(2, optionsOf(configuration, 1.0F));
    both[1].masking = true;
    std::array<double, 2> triangles{};
    for (std::size_t i = 0; i < 2; ++i) {
      settledImage(renderer, both[i], camera);
      triangles[i] = static_cast<double>(renderer.readStatistics().triangles);
    }
    const std::vector<Timed> timed = {{renderer, both[0]}, {renderer, both[1]}};
    const std::vector<double> frame = interleavedTimes(timed, camera, kRounds);
    const std::vector<double> analysis = interleavedTimes(timed, camera, kRounds, "analyse");
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} |\n", configuration.name, triangles[1] / triangles[0],
               frame[1] / frame[0], analysis[1] / analysis[0]);
    std::fflush(stdout);
    figures.push_back({{"scene", view.sceneName},
                       {"view", view.text},
                       {"configuration", configuration.name},
                       {"triangle_ratio", triangles[1] / triangles[0]},
                       {"frame_ratio", frame[1] / frame[0]},
                       {"analysis_ratio", analysis[1] / analysis[0]},
                       {"analysis_share_of_frame", analysis[1] / frame[1]}});
  }
}

}  // namespace jalousie::bench
