// Cost of every deciding pass per object at 10 thousand, 100 thousand and a million objects, beside a compute pass that
// only copies the objects' transforms: the least any such pass can cost. Compare rows of one run only.
//
//   build/release/bin/scaling_bench [--json] [COUNT...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "platform/headless_context.h"
#include "render/scene_buffers.h"
#include "scene/camera.h"
#include "support/scenes.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/statistics_pass.h"
#include "visibility/visibility_pass.h"

namespace {

using namespace jalousie;

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;
constexpr int kRepeats = 7;

/// Spheres of many sizes with ten levels in a cube, some mirrored; the camera sees about half of them.
scene::SceneData makeScene(std::uint32_t count) {
  asset::SceneFile file = test::sphereChain(5);
  for (std::uint32_t level = 5; level < 10; ++level)
    file.chains[0].levels.push_back({4, 0.4F * static_cast<float>(level)});
  Random random(7);
  const float side = std::cbrt(static_cast<float>(count));
  for (std::uint32_t i = 0; i < count; ++i)
    test::addInstance(file, 0, {random.uniform(-side, side), random.uniform(-side, side), random.uniform(-side, side)},
                      {random.below(8) == 0 ? -0.3F : 0.3F, 0.3F, random.uniform(0.1F, 0.6F)}, random.uniform(0, 6));
  return scene::buildScene(file);
}

/// Depth of a perforated wall through the middle of the cube.
gl::Texture makeDepth(float wallDepth) {
  gl::Texture depth(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {kWidth, kHeight, 1, 1}, "wall");
  Random random(3);
  std::vector<float> values(std::size_t{kWidth} * kHeight);
  std::vector<bool> open(std::size_t{kWidth / 32 + 1} * (kHeight / 32 + 1));
  for (std::size_t i = 0; i < open.size(); ++i)
    open[i] = random.below(5) == 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      values[std::size_t{y} * kWidth + x] = open[std::size_t{y / 32} * (kWidth / 32 + 1) + x / 32] ? 0.0F : wallDepth;
  glTextureSubImage2D(depth.id(), 0, 0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
  return depth;
}

/// One thread copies one transform.
class CopyPass {
 public:
  CopyPass(const gl::Buffer& source, std::uint32_t count)
      : source_(source), count_(count), target_(source.sizeBytes(), 0, "copy") {
    const char* text = R"(#version 450 core
layout(local_size_x = 64) in;
struct Transform { vec4 row0; vec4 row1; vec4 row2; };
layout(std430, binding = 0) readonly buffer Source { Transform source[]; };
layout(std430, binding = 1) writeonly buffer Target { Transform target[]; };
void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id < uint(source.length())) target[id] = source[id];
})";
    program_ = gl::Handle<gl::ProgramTraits>(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text));
  }
  void run() const {
    glUseProgram(program_.id());
    source_.bindStorage(0);
    target_.bindStorage(1);
    glDispatchCompute((count_ + 63) / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

 private:
  const gl::Buffer& source_;
  std::uint32_t count_;
  gl::Buffer target_;
  gl::Handle<gl::ProgramTraits> program_;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Row {
  std::uint32_t count = 0;
  std::vector<std::pair<std::string, double>> passes;  ///< name, nanoseconds per object
  double pyramidMs = 0.0;
  std::uint64_t early = 0, late = 0, occluded = 0;
};

Row measure(std::uint32_t count) {
  const scene::SceneData scene = makeScene(count);
  render::SceneBuffers buffers(scene);
  const visibility::SceneBindings bindings = buffers.bindings();
  const visibility::MapLayout layout = visibility::mapLayout(kWidth, kHeight);
  visibility::VisibilityPass deciding(buffers.objectCount());
  visibility::DepthPyramidPass pyramid(layout, gl::queryCapabilities());
  visibility::DrawListPass lists(scene);
  const visibility::DrawListOptions listOptions{visibility::Submission::kInstanced, buffers.objectCount(), false};
  visibility::DrawList early(scene, gpu::kMarkEarly, listOptions);
  visibility::DrawList late(scene, gpu::kMarkLate, listOptions);
  visibility::StatisticsPass statistics;
  const CopyPass copy(buffers.transforms(), buffers.objectCount());

  const float side = std::cbrt(static_cast<float>(count));
  const scene::Camera camera = scene::lookAt({0.1F, 0.2F, 1.3F * side}, {0, 0, 0}, scene.boundsWorld);
  const gl::Texture depth = makeDepth(camera.zNear / (0.8F * side));
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, static_cast<float>(kWidth) / kHeight);
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.viewportWidth = kWidth;
  view.viewportHeight = kHeight;
  view.objectCount = buffers.objectCount();
  view.cullMode = gpu::kCullHiz;
  view.lodRule = gpu::kLodPixelError;
  view.mapLevels = layout.levels;
  view.cullThreshold = 1.0F;
  view.maxTessellation = 20;
  view.focalPixels = scene::focalPixels(camera, kHeight);
  view.tau = 1.0F;
  deciding.setView(view);

  const std::vector<std::pair<std::string, std::function<void()>>> passes = {
      {"copy", [&] { copy.run(); }},
      {"classify", [&] { deciding.classify(bindings); }},
      {"early list", [&] { lists.build(early, bindings, deciding); }},
      {"pyramid", [&] { pyramid.build(depth, visibility::DepthSource::kAll); }},
      {"analyse",
       [&] {
         deciding.analyse(bindings, gpu::kCullHiz, {nullptr, &pyramid, &depth});
       }},
      {"late list", [&] { lists.build(late, bindings, deciding); }},
      {"count", [&] { statistics.endFrame(bindings, deciding, view, &early, late); }},
  };
  std::map<std::string, std::vector<double>> samples;
  for (int frame = 0; frame < kRepeats + 2; ++frame) {
    for (const auto& [name, run] : passes) {
      glFinish();
      const auto start = std::chrono::steady_clock::now();
      run();
      glFinish();
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
      if (frame >= 2) samples[name].push_back(time.count());
    }
  }
  const auto record = statistics.finish();
  Row row;
  row.count = count;
  row.early = record->counters[gpu::kCounterEarly];
  row.late = record->counters[gpu::kCounterLate];
  row.occluded = record->counters[gpu::kCounterVerdicts + gpu::kVerdictOccluded];
  for (const auto& [name, run] : passes) {
    if (name == "pyramid") {
      row.pyramidMs = median(samples[name]) * 1e-6;
    } else {
      row.passes.emplace_back(name, median(samples[name]) / count);
    }
  }
  return row;
}

void printText(const std::vector<Row>& rows, const std::string& renderer) {
  std::printf("ns per object, median of %d runs, %ux%u, %s\n", kRepeats, kWidth, kHeight, renderer.c_str());
  std::printf("| objects |");
  for (const auto& [name, ns] : rows.front().passes)
    std::printf(" %s |", name.c_str());
  std::printf(" all passes / copy | pyramid, ms | drawn, hidden |\n|---|");
  for (std::size_t i = 0; i < rows.front().passes.size() + 3; ++i)
    std::printf("---|");
  std::printf("\n");
  for (const Row& row : rows) {
    double sum = 0.0;
    std::printf("| %u |", row.count);
    for (const auto& [name, ns] : row.passes) {
      std::printf(" %.1f |", ns);
      if (name != "copy") sum += ns;
    }
    std::printf(" %.1f | %.1f | %llu, %llu |\n", sum / row.passes.front().second, row.pyramidMs,
                static_cast<unsigned long long>(row.early + row.late), static_cast<unsigned long long>(row.occluded));
  }
}

void printJson(const std::vector<Row>& rows, const std::string& renderer) {
  nlohmann::ordered_json json;
  json["renderer"] = renderer;
  for (const Row& row : rows) {
    nlohmann::ordered_json entry;
    entry["objects"] = row.count;
    for (const auto& [name, ns] : row.passes)
      entry["ns_per_object"][name] = ns;
    entry["pyramid_ms"] = row.pyramidMs;
    entry["drawn"] = row.early + row.late;
    entry["occluded"] = row.occluded;
    json["rows"].push_back(entry);
  }
  std::printf("%s\n", json.dump(2).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint32_t> counts;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) {
      json = true;
    } else if (const unsigned long count = std::strtoul(argv[i], nullptr, 10); count > 0 && count <= 4000000) {
      counts.push_back(static_cast<std::uint32_t>(count));
    } else {
      std::fprintf(stderr, "usage: scaling_bench [--json] [COUNT...]   (1..4000000 objects)\n");
      return 2;
    }
  }
  if (counts.empty()) counts = {10000, 100000, 1000000};
  try {
    const platform::HeadlessContext context(false);
    std::vector<Row> rows;
    for (const std::uint32_t count : counts)
      rows.push_back(measure(count));
    (json ? printJson : printText)(rows, context.capabilities().renderer);
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "scaling_bench: %s\n", error.what());
    return error.exitCode();
  }
}
