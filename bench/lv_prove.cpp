// Measures the candidates of the proving table in one view: still pictures, a slow path, frame times.
#include "lv_prove.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "gl_bench.h"
#include "lv_path.h"
#include "lv_sweep.h"
#include "lv_times.h"

namespace jalousie::bench {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;
/// The first seven are kTaus.
constexpr float kSweepTaus[] = {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F, 0.0625F, 0.03125F};

/// How far a sweep goes: counts of kSweepTaus.
struct SweepRange {
  std::size_t least;     ///< measured at any cost
  std::size_t usual;     ///< measured unless frames have more than mostTriangles
  std::size_t most;      ///< further ones are measured until the finest error that is compared is reached
  double mostTriangles;  ///< mean per frame; from here on, a sweep takes long on a software renderer
};
constexpr SweepRange kStillRange = {kOnePixel + 2, 7, 9, kMostTriangles};
constexpr SweepRange kMovingRange = {kOnePixel + 1, 6, 8, 2e6};
constexpr int kPathFrames = 64;
constexpr int kComparedEvery = 8;  // frames
constexpr int kRounds = 9;         // of frame times

struct Candidate {
  const char* name;
  const LvConfiguration& configuration;
  bool cells;
};
const Candidate kBaseline = {"pixel-error", kUniform, false};
const Candidate kCandidates[] = {{"lv-error", kRelaxed, false},
                                 {"price", kDefault, false},
                                 {"pixel-error+cells", kUniform, true},
                                 {"lv-error+cells", kRelaxed, true},
                                 {"price+cells", kDefault, true}};

/// What one candidate, or the baseline, showed in one view.
struct Measured {
  std::vector<Sample> still;
  std::vector<Sample> moving;
  std::vector<ImageRgba8> stillPictures;   ///< of levels by pixel error
  std::vector<ImageRgba8> movingPictures;  ///< likewise
  double switches = std::nan("");          ///< share of visible objects per frame of the path
  double frameMs = std::nan("");           ///< median, at a tau of one pixel
};

/// A candidate with a renderer of its own, so that no other one disturbs its history.
struct Run {
  const Candidate& candidate;
  std::unique_ptr<render::FrameRenderer> renderer;
  Measured measured = {};

  bool keepsPictures() const { return candidate.configuration.rule == LodRule::kPixelError; }
};

/// The pixels in which two lists of pictures differ, in the worst pair; the longer list's rest is left out.
std::uint64_t wrongPixels(const std::vector<ImageRgba8>& expected, const std::vector<ImageRgba8>& actual) {
  std::uint64_t worst = 0;
  for (std::size_t i = 0; i < std::min(expected.size(), actual.size()); ++i) {
    const std::vector<std::uint8_t>& a = expected[i].pixels;
    const std::vector<std::uint8_t>& b = actual[i].pixels;
    std::uint64_t wrong = 0;
    for (std::size_t at = 0; at < a.size(); at += 4)
      wrong += std::equal(&a[at], &a[at] + 3, &b[at]) ? 0 : 1;
    worst = std::max(worst, wrong);
  }
  return worst;
}

/// Whether a sweep reaches the finest error of the baseline that is compared, in all measures.
bool isFineEnough(const std::vector<Sample>& samples, const std::vector<Sample>& base) {
  if (base.empty()) return true;  // the baseline itself
  const Sample& finest = base[std::min(kOnePixel + 2, base.size() - 1)];
  return std::ranges::none_of(kMeasures, [&](const ErrorMeasure& measure) {
    return measure.quality(samples.back()) < measure.quality(finest);
  });
}

/// Samples over falling tau. @param base  of the baseline; empty for itself
std::vector<Sample> sweep(const SweepRange& range, const std::vector<Sample>& base,
                          const std::function<Sample(float tau)>& sampleAt) {
  std::vector<Sample> samples;
  while (samples.size() < range.most) {
    if (samples.size() >= range.usual && isFineEnough(samples, base)) break;
    samples.push_back(sampleAt(kSweepTaus[samples.size()]));
    if (samples.size() >= range.least && samples.back().triangles > range.mostTriangles) break;
  }
  return samples;
}

/// All candidates in one view.
class ViewProof {
 public:
  ViewProof(const LvView& view, const scene::SceneData& divided, const ProveOptions& options)
      : view_(view), options_(options), isDivided_(!divided.cells.objects.empty()) {
    addRun(kBaseline, view.scene);
    for (const Candidate& candidate : kCandidates) {
      if (std::ranges::find(options.candidates, candidate.name) == options.candidates.end()) continue;
      addRun(candidate, candidate.cells ? divided : view.scene);
    }
  }

  void measure() {
    if (options_.still) still();
    if (options_.moving) moving();
    if (options_.still) times();
    for (Run& run : runs_)
      if (const Run* twin = twinOf(run)) run.measured = twin->measured;
  }

  void addTo(nlohmann::ordered_json& figures) const {
    for (const Run& run : runs_) {
      figures["sweeps"].push_back({{"scene", view_.sceneName},
                                   {"view", view_.text},
                                   {"rule", run.candidate.name},
                                   {"still", toJson(run.measured.still)},
                                   {"moving", toJson(run.measured.moving)}});
      if (&run != &runs_.front()) figures["rows"].push_back(rowOf(run));
    }
  }

 private:
  void addRun(const Candidate& candidate, const scene::SceneData& scene) {
    runs_.push_back({candidate, std::make_unique<render::FrameRenderer>(scene, kWidth, kHeight)});
  }

  /// In a scene without cells: the run with the same rule on whole objects, whose results are the same.
  const Run* twinOf(const Run& run) const {
    if (isDivided_ || !run.candidate.cells) return nullptr;
    const auto twin = std::ranges::find_if(runs_, [&](const Run& other) {
      return !other.candidate.cells && &other.candidate.configuration == &run.candidate.configuration;
    });
    return twin == runs_.end() ? nullptr : &*twin;
  }

  void report(const char* part, const char* name) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    fmt::print(stderr, "{}, view {}: {}, {} ({:.1f} s)\n", view_.sceneName, view_.text, part, name, seconds);
  }

  void still() {
    const scene::Camera camera = view_.camera();
    const Reference reference = coveredReference(*runs_.front().renderer, camera);
    report("still", "reference");
    for (Run& run : runs_) {
      if (twinOf(run) != nullptr) continue;
      Stage stage{*run.renderer, camera, reference};
      if (run.keepsPictures()) stage.pictures = &run.measured.stillPictures;
      run.measured.still = sweep(kStillRange, runs_.front().measured.still,
                                 [&](float tau) { return stage.sample(optionsOf(run.candidate.configuration, tau)); });
      requireImproves(run.measured.still, run.candidate.name);
      report("still", run.candidate.name);
    }
  }

  void moving() {
    const Path path{view_.camera(), view_.scene.boundsWorld.center(), kPathFrames};
    std::vector<Reference> references;
    for (int frame = kComparedEvery; frame <= kPathFrames; frame += kComparedEvery)
      references.push_back(coveredReference(*runs_.front().renderer, path.at(frame)));
    report("moving", "references");
    for (Run& run : runs_) {
      if (twinOf(run) != nullptr) continue;
      run.measured.moving = sweep(kMovingRange, runs_.front().measured.moving,
                                  [&](float tau) { return alongPath(run, path, references, tau); });
      requireImproves(run.measured.moving, run.candidate.name);
      report("moving", run.candidate.name);
    }
  }

  /// Mean triangles of all frames, mean errors of every eighth.
  static Sample alongPath(Run& run, const Path& path, const std::vector<Reference>& references, float tau) {
    render::FrameRenderer& renderer = *run.renderer;
    std::vector<Sample> compared;
    SwitchTotals switches;
    double triangles = 0.0;
    const auto isCompared = [](int frame) { return frame % kComparedEvery == 0; };
    renderer.resetHistory();
    walk(renderer, optionsOf(run.candidate.configuration, tau, /*calm=*/true), path, isCompared, [&](int frame) {
      const render::FrameStatistics statistics = renderer.readStatistics();
      requireCounts(statistics, "a frame of the path");
      triangles += static_cast<double>(statistics.triangles) / kPathFrames;
      if (isCompared(frame)) {
        ImageRgba8 picture = renderer.readImage();
        compared.push_back(references[static_cast<std::size_t>(frame / kComparedEvery) - 1].errorsOf(picture));
        if (run.keepsPictures()) run.measured.movingPictures.push_back(std::move(picture));
      }
      if (tau == 1.0F) switches.add(renderer);
    });
    if (tau == 1.0F) run.measured.switches = switches.perObject();
    Sample mean = meanOf(compared);
    mean.triangles = triangles;
    return mean;
  }

  void times() {
    std::vector<Timed> timed;
    std::vector<Run*> order;
    for (Run& run : runs_) {
      if (twinOf(run) != nullptr) continue;
      timed.push_back({*run.renderer, optionsOf(run.candidate.configuration, 1.0F)});
      order.push_back(&run);
    }
    const std::vector<double> medians = interleavedTimes(timed, view_.camera(), kRounds);
    for (std::size_t i = 0; i < medians.size(); ++i)
      order[i]->measured.frameMs = medians[i];
    report("still", "frame times");
  }

  /// An array per sample: tau, triangles, PSNR, SSIM, FLIP.
  static nlohmann::ordered_json toJson(const std::vector<Sample>& samples) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < samples.size(); ++i)
      all.push_back(
          {kSweepTaus[i], samples[i].triangles, orNull(samples[i].psnr), samples[i].ssim, orNull(samples[i].flip)});
    return all;
  }

  /// For each measure the mean ratio, and on how many of the four errors it rests.
  static nlohmann::ordered_json ratios(const std::vector<Sample>& samples, const std::vector<Sample>& base) {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    if (samples.empty()) return all;
    for (const ErrorMeasure& measure : kMeasures) {
      const std::vector<double> each = ratiosAtEqualErrors(samples, base, base, measure);
      all[measure.name] = orNull(geometricMean(each));
      all["errors"][measure.name] = std::ranges::count_if(each, [](double ratio) { return !std::isnan(ratio); });
    }
    return all;
  }

  nlohmann::ordered_json rowOf(const Run& run) const {
    const Measured& base = runs_.front().measured;
    const Measured& own = run.measured;
    nlohmann::ordered_json wrong;
    if (run.candidate.cells && run.keepsPictures())
      wrong = std::max(wrongPixels(base.stillPictures, own.stillPictures),
                       wrongPixels(base.movingPictures, own.movingPictures));
    return {{"scene", view_.sceneName},
            {"view", view_.text},
            {"candidate", run.candidate.name},
            {"divided", isDivided_},
            {"still", ratios(own.still, base.still)},
            {"moving", ratios(own.moving, base.moving)},
            {"switches", orNull(own.switches)},
            {"switches_of_baseline", orNull(base.switches)},
            {"frame_ratio", orNull(own.frameMs / base.frameMs)},
            {"wrong_pixels", wrong}};
  }

  const LvView& view_;
  const ProveOptions& options_;
  bool isDivided_;
  std::vector<Run> runs_;  ///< the baseline first
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<std::string> proveCandidates() {
  std::vector<std::string> names;
  for (const Candidate& candidate : kCandidates)
    names.emplace_back(candidate.name);
  return names;
}

void measureProve(const LvView& view, const scene::SceneData& divided, const ProveOptions& options,
                  nlohmann::ordered_json& figures) {
  ViewProof proof(view, divided, options);
  proof.measure();
  proof.addTo(figures);
}

}  // namespace jalousie::bench
