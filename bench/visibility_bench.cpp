// Measures the cost per object of deciding what to draw: the occlusion culling modes against frustum culling alone, on
// spheres behind a perforated wall. On a software renderer, compare rows of one run only.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench_head.h"
#include "cli/program.h"
#include "platform/headless_context.h"
#include "render/frame_renderer.h"
#include "support/stages.h"
#include "visibility/level_of_visibility.h"

namespace {

using namespace jalousie;

/// `count` spheres in a deep grid behind the wall.
asset::SceneFile manySpheres(std::int64_t count) {
  asset::SceneFile file = test::spheresBehindWall(0.35F);
  file.instances.resize(1);
  Random random(7);
  for (std::int64_t i = 1; i < count; ++i)
    test::addInstance(file, 0,
                      {random.uniform(-4.0F, 4.0F), random.uniform(-3.0F, 3.0F), random.uniform(-20.0F, -2.0F)},
                      glm::vec3(0.1F));
  return file;
}

/// Message if the counts of a frame are wrong, else null.
const char* problemOf(const render::FrameStatistics& s, LodRule rule) {
  if (s.drawn == 0) return "nothing was drawn";
  if (s.drawn + s.culledFrustum + s.culledOcclusion + s.culledSmall != s.objects)
    return "drawn and culled objects do not add up to all objects";
  if (rule == LodRule::kLinear && s.triangles >= s.trianglesFinest) return "no object has a coarser level";
  return nullptr;
}

bool failed = false;  ///< some benchmark measured a wrong result

void fail(benchmark::State& state, const char* problem) {
  failed = true;
  state.SkipWithError(problem);
}

void decide(benchmark::State& state, CullMode mode, LodRule rule) {
  const scene::SceneData scene = scene::buildScene(manySpheres(state.range(0)));
  render::FrameRenderer renderer(scene, 1280, 720);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  render::FrameOptions options;
  options.cullMode = mode;
  options.lodRule = rule;
  options.skipDraw = true;
  options.occluderDistance = test::kWallOccluderDistance;
  renderer.render(options, camera, camera);  // warm-up: the driver compiles the shaders
  glFinish();
  for (auto _ : state) {
    renderer.render(options, camera, camera);
    glFinish();
  }
  const render::FrameStatistics statistics = renderer.readStatistics();
  if (const char* problem = problemOf(statistics, rule)) fail(state, problem);
  state.counters["triangles"] = static_cast<double>(statistics.triangles);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// The baseline.
void frustumOnly(benchmark::State& state) {
  decide(state, CullMode::kFrustum, LodRule::kFinest);
}
void occlusionMap(benchmark::State& state) {
  decide(state, CullMode::kHom, LodRule::kFinest);
}
void occlusionMapAndLv(benchmark::State& state) {
  decide(state, CullMode::kHom, LodRule::kLinear);
}
void twoPhases(benchmark::State& state) {
  decide(state, CullMode::kHiz, LodRule::kPixelError);
}

std::vector<float> randomBlock() {
  Random random(3);
  std::vector<float> values(256);
  for (float& value : values)
    value = random.uniform(-0.5F, 0.5F);
  return values;
}

/// The baseline of lowCoefficients16x16: all coefficients.
void dct16x16(benchmark::State& state) {
  const std::vector<float> values = randomBlock();
  for (auto _ : state)
    benchmark::DoNotOptimize(visibility::dct2d({16, 16, values}));
}

void lowCoefficients16x16(benchmark::State& state) {
  const std::vector<float> values = randomBlock();
  for (auto _ : state)
    benchmark::DoNotOptimize(visibility::lowCoefficients({16, 16, values}));
  const visibility::LowCoefficients low = visibility::lowCoefficients({16, 16, values});
  const std::vector<double> all = visibility::dct2d({16, 16, values});
  const double largest =
      std::max({std::abs(static_cast<double>(low.f00) - all[0]), std::abs(static_cast<double>(low.f10) - all[1]),
                std::abs(static_cast<double>(low.f01) - all[16]), std::abs(static_cast<double>(low.f11) - all[17])});
  if (largest > 1e-4) fail(state, "the coefficients differ from the whole transform's");
}

BENCHMARK(frustumOnly)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(occlusionMap)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(occlusionMapAndLv)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(twoPhases)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(dct16x16);
BENCHMARK(lowCoefficients16x16);

void printHelp() {
  std::printf(
      "Measures the cost per object of the culling modes against frustum culling\n"
      "Usage: visibility_bench [--json FILE] [options of Google Benchmark]\n"
      "  --json FILE                   Write head and figures as JSON to this file; as --benchmark_out=FILE\n\n");
  benchmark::PrintDefaultHelp();
  std::printf(
      "Examples:\n"
      "  visibility_bench\n"
      "  visibility_bench --benchmark_filter=/1000/ --json visibility.json\n"
      "The exit code is 1 if a benchmark measured a wrong result.\n");
}

/// Replaces --json FILE by the options of Google Benchmark.
std::vector<std::string> translated(const std::vector<std::string>& arguments) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] != "--json" || i + 1 == arguments.size()) {
      result.push_back(arguments[i]);
      continue;
    }
    result.push_back("--benchmark_out=" + arguments[++i]);
    result.emplace_back("--benchmark_out_format=json");
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  std::vector<std::string> words = translated(arguments);
  words.insert(words.begin(), argv[0]);
  std::vector<char*> pointers;
  for (std::string& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, pointers.data(), printHelp);
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  return cli::runProgram("visibility_bench", [&] {
    const platform::HeadlessContext context(/*debug=*/false);
    bench::Head head = bench::makeHead("visibility_bench", arguments);
    head.renderer = context.capabilities().renderer;
    head.version = context.capabilities().version;
    for (const auto& [key, value] : bench::fieldsOf(head))
      benchmark::AddCustomContext(key, value);
    benchmark::RunSpecifiedBenchmarks();
    return failed ? 1 : 0;
  });
}
