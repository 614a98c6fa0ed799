// Cost of deciding, per object: the visibility passes against frustum culling alone, on spheres behind a perforated
// wall. Pass times on a software renderer are wall times between two glFinish; compare rows of one run only.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>

#include "core/error.h"
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

void decide(benchmark::State& state, gpu::uint mode, gpu::uint rule) {
  const scene::SceneData scene = scene::buildScene(manySpheres(state.range(0)));
  render::FrameRenderer renderer(scene, 1280, 720);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  render::FrameOptions options;
  options.cullMode = mode;
  options.lodRule = rule;
  options.skipDraw = true;
  options.occluderDistance = test::kWallOccluderDistance;
  renderer.render(options, camera, camera);  // warm-up: shader compilation
  glFinish();
  for (auto _ : state) {
    renderer.render(options, camera, camera);
    glFinish();
  }
  // The result is checked after the clock stopped.
  const render::FrameStatistics statistics = renderer.readStatistics();
  if (statistics.drawn == 0 || (rule == gpu::kLodLinear && statistics.triangles >= statistics.trianglesFull))
    state.SkipWithError("the passes decided nothing");
  state.counters["triangles"] = static_cast<double>(statistics.triangles);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void frustumOnly(benchmark::State& state) {
  decide(state, gpu::kCullFrustum, gpu::kLodFinest);
}
void occlusionMap(benchmark::State& state) {
  decide(state, gpu::kCullHom, gpu::kLodFinest);
}
void occlusionMapAndLv(benchmark::State& state) {
  decide(state, gpu::kCullHom, gpu::kLodLinear);
}
void twoPhases(benchmark::State& state) {
  decide(state, gpu::kCullHiz, gpu::kLodPixelError);
}

void lowCoefficients16x16(benchmark::State& state) {
  Random random(3);
  std::vector<float> values(256);
  for (float& value : values)
    value = random.uniform(-0.5F, 0.5F);
  for (auto _ : state)
    benchmark::DoNotOptimize(visibility::lowCoefficients({16, 16, values}));
}

BENCHMARK(frustumOnly)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(occlusionMap)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(occlusionMapAndLv)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(twoPhases)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(lowCoefficients16x16);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const platform::HeadlessContext context(false);
    benchmark::AddCustomContext("renderer", context.capabilities().renderer);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "visibility_bench: %s\n", error.what());
    return error.exitCode();
  }
}
