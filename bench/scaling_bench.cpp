// Measures the cost per object of every pass that decides what to draw, from 10 thousand to a million objects, beside a
// compute pass that only copies the objects' transforms. Compare rows of one run only.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/median.h"
#include "gl/capabilities.h"
#include "gl_bench.h"
#include "policy/cull_mode.h"
#include "render/scene_buffers.h"
#include "scaling_scene.h"
#include "visibility/classify_reference.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/frame_counters.h"
#include "visibility/statistics_pass.h"
#include "visibility/visibility_pass.h"

namespace {

using namespace jalousie;

constexpr int kWarmUp = 2;
constexpr int kRepeats = 7;
constexpr const char* kCopy = "copy";
constexpr const char* kPyramid = "pyramid";
/// Kernel and CPU twin may disagree about objects on the border of the frustum; this share of them is accepted.
constexpr double kBorderShare = 1e-4;

struct Row {
  std::uint32_t count = 0;
  std::vector<std::pair<std::string, double>> passes;  ///< name, nanoseconds per object
  double pyramidMs = 0.0;
  std::uint64_t drawn = 0, occluded = 0, outside = 0;
};

/// The passes of a frame with two-phase culling, and everything that they work on.
class Frame {
 public:
  explicit Frame(const scene::SceneData& scene)
      : scene_(scene),
        buffers_(scene),
        layout_(visibility::mapLayout(bench::kScalingWidth, bench::kScalingHeight)),
        objects_(buffers_.objectCount()),
        deciding_(objects_),
        pyramid_(layout_, gl::queryCapabilities()),
        lists_(scene),
        early_(scene, gpu::kMarkEarly, listOptions()),
        late_(scene, gpu::kMarkLate, listOptions()),
        copy_(buffers_.transforms(), buffers_.objectCount()),
        depth_(bench::makeWallDepth(scene)),
        view_(bench::scalingView(scene, layout_.levels)) {
    deciding_.setView(view_);
  }

  /// Names and passes in frame order.
  std::vector<std::pair<std::string, std::function<void()>>> passes() {
    const visibility::SceneBindings scene = buffers_.bindings();
    return {
        {kCopy, [this] { copy_.run(); }},
        {"classify", [this, scene] { deciding_.classify(scene); }},
        {"early list", [this, scene] { lists_.build(early_, scene, deciding_.decided()); }},
        {kPyramid, [this] { pyramid_.build(depth_, visibility::DepthSource::kAll); }},
        {"analyse",
         [this, scene] {
           deciding_.analyse(scene, traitsOf(CullMode::kHiz), {nullptr, &pyramid_.texture(), &depth_});
         }},
        {"late list", [this, scene] { lists_.build(late_, scene, deciding_.decided()); }},
        {"count", [this, scene] { statistics_.endFrame(scene, deciding_.decided(), view_, &early_, late_); }},
    };
  }

  /// Fills the counts of a row and requires that they are right.
  void check(Row& row) {
    const auto record = statistics_.finish();
    bench::require(record.has_value(), "no statistics have arrived");
    const auto verdict = [&](gpu::uint v) { return std::uint64_t{record->counters[gpu::kCounterVerdicts + v]}; };
    row.drawn = std::uint64_t{record->counters[gpu::kCounterEarly]} + record->counters[gpu::kCounterLate];
    row.occluded = verdict(gpu::kVerdictOccluded);
    row.outside = verdict(gpu::kVerdictOutside);
    bench::require(copy_.isRight(), "the copy pass copied wrong bytes");
    bench::require(row.drawn + row.occluded + row.outside == row.count,
                   fmt::format("{} objects drawn, {} occluded, {} outside, of {}", row.drawn, row.occluded, row.outside,
                               row.count));
    const std::uint64_t expected = outsideByTwin();
    const double difference = std::abs(static_cast<double>(row.outside) - static_cast<double>(expected));
    bench::require(difference <= kBorderShare * row.count,
                   fmt::format("{} objects outside the frustum; the CPU twin finds {}", row.outside, expected));
  }

 private:
  visibility::DrawListOptions listOptions() const {
    return {visibility::Submission::kInstanced, buffers_.objectCount(), false};
  }

  std::uint64_t outsideByTwin() const {
    std::uint64_t outside = 0;
    for (gpu::uint object = 0; object < view_.objectCount; ++object)
      outside += visibility::classifyObject(scene_, view_, object, {}).state.verdict == gpu::kVerdictOutside ? 1 : 0;
    return outside;
  }

  const scene::SceneData& scene_;
  render::SceneBuffers buffers_;
  visibility::MapLayout layout_;
  visibility::ObjectStore objects_;
  visibility::VisibilityPass deciding_;
  visibility::DepthPyramidPass pyramid_;
  visibility::DrawListPass lists_;
  visibility::DrawList early_;
  visibility::DrawList late_;
  visibility::StatisticsPass statistics_;
  bench::CopyPass copy_;
  gl::Texture depth_;
  gpu::CullView view_;
};

Row measure(std::uint32_t count) {
  const scene::SceneData scene = bench::makeScalingScene(count);
  Frame frame(scene);
  const auto passes = frame.passes();
  std::map<std::string, std::vector<double>> samples;  // nanoseconds
  for (int repeat = 0; repeat < kWarmUp + kRepeats; ++repeat) {
    for (const auto& [name, run] : passes) {
      glFinish();
      const auto start = std::chrono::steady_clock::now();
      run();
      glFinish();
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
      if (repeat >= kWarmUp) samples[name].push_back(time.count());
    }
  }
  Row row;
  row.count = count;
  for (const auto& [name, run] : passes)
    if (name != kPyramid) row.passes.emplace_back(name, median(samples[name]) / count);
  row.pyramidMs = median(samples[kPyramid]) * 1e-6;
  frame.check(row);
  return row;
}

void print(const std::vector<Row>& rows) {
  fmt::print("Nanoseconds per object, median of {} runs, {}x{}\n| objects |", kRepeats, bench::kScalingWidth,
             bench::kScalingHeight);
  for (const auto& [name, ns] : rows.front().passes)
    fmt::print(" {} |", name);
  fmt::print(" all passes / copy | pyramid, ms | drawn, occluded |\n|---|");
  for (std::size_t i = 0; i < rows.front().passes.size() + 3; ++i)
    fmt::print("---|");
  fmt::print("\n");
  for (const Row& row : rows) {
    double sum = 0.0;
    fmt::print("| {} |", row.count);
    for (const auto& [name, ns] : row.passes) {
      fmt::print(" {:.1f} |", ns);
      if (name != kCopy) sum += ns;
    }
    fmt::print(" {:.1f} | {:.1f} | {}, {} |\n", sum / row.passes.front().second, row.pyramidMs, row.drawn,
               row.occluded);
  }
}

nlohmann::ordered_json toJson(const Row& row) {
  nlohmann::ordered_json json;
  json["objects"] = row.count;
  for (const auto& [name, ns] : row.passes)
    json["ns_per_object"][name] = ns;
  json["pyramid_ms"] = row.pyramidMs;
  json["drawn"] = row.drawn;
  json["occluded"] = row.occluded;
  json["outside"] = row.outside;
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint32_t> counts = {10000, 100000, 1000000};
  bench::GlBench bench(
      "scaling_bench", "Measures the cost per object of every pass that decides what to draw",
      R"(The column "copy" is the baseline: a pass that only copies the objects' transforms. The exit code is 1 if the passes'
counts are wrong. On a software renderer, compare rows of one run only.
Examples:
  scaling_bench
      measures 10000, 100000 and 1000000 objects
  scaling_bench --json scaling.json 50000
      measures 50000 objects and writes the figures
)");
  bench.options()
      .add_option("counts", counts, "Numbers of objects")
      ->check(CLI::Range(1U, 4000000U).description(""))
      ->type_name("1..4000000")
      ->default_str("10000 100000 1000000");
  return bench.run(argc, argv, [&](nlohmann::ordered_json& figures) {
    std::vector<Row> rows;
    for (const std::uint32_t count : counts)
      rows.push_back(measure(count));
    print(rows);
    for (const Row& row : rows)
      figures.push_back(toJson(row));
  });
}
