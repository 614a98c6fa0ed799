// Back faces that are left out before they are drawn: how many by each test, at what cost, and whether the picture is
// the same.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "core/error.h"
#include "core/median.h"
#include "gl_bench.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/culling.h"

namespace {

using namespace jalousie;

struct Arguments {
  std::vector<std::string> scenes;
  std::uint32_t frames = 12;
  std::uint32_t repeat = 3;
  bool finest = false;
  bool cells = true;
};

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;

/// What one test did over all frames.
struct Measured {
  render::FrameStatistics sum;
  std::vector<double> ms;  ///< of each frame the median
  std::uint64_t wrongFrames = 0;
};

/// Time of one frame between two waits for the GPU, milliseconds.
double timed(render::FrameRenderer& renderer, const render::FrameOptions& options, const scene::Camera& camera) {
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  renderer.render(options, camera, camera);
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

render::FrameOptions optionsOf(const Arguments& arguments, FaceCulling test) {
  render::FrameOptions options;
  options.cullMode = CullMode::kFrustum;
  options.lodRule = arguments.finest ? LodRule::kFinest : LodRule::kPixelError;
  options.faceCulling = test;
  return options;
}

void addTo(render::FrameStatistics& sum, const render::FrameStatistics& frame) {
  sum.triangles += frame.triangles;
  sum.draws += frame.draws;
  sum.facesTested += frame.facesTested;
  sum.facesCulled += frame.facesCulled;
  sum.facesWhole += frame.facesWhole;
}

/// All tests in turn in each frame, so that the load of the machine meets all of them.
std::vector<Measured> measure(const Arguments& arguments, const scene::SceneData& scene) {
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const auto camera = test::tour(scene, std::max(arguments.frames / 4, 1U), 7);
  std::vector<Measured> results(faceCullingTable().size());
  for (std::uint32_t frame = 0; frame < arguments.frames; ++frame) {
    std::vector<std::uint8_t> plain;
    std::vector<std::vector<double>> times(results.size());
    for (std::uint32_t round = 0; round <= arguments.repeat; ++round) {
      for (const FaceCullingRow& row : faceCullingTable()) {
        const auto index = static_cast<std::size_t>(row.id);
        const double ms = timed(renderer, optionsOf(arguments, row.id), camera(frame));
        if (round > 0) {
          times[index].push_back(ms);
          continue;
        }
        addTo(results[index].sum, renderer.readStatistics());
        const ImageRgba8 image = renderer.readImage();
        if (row.id == FaceCulling::kOff) plain = image.pixels;
        results[index].wrongFrames += image.pixels != plain ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < results.size(); ++i)
      results[i].ms.push_back(median(times[i]));
  }
  return results;
}

/// Compares the pictures of each level of the chains, from outside and from two places of the tour.
/// @return  levels of the longest chain
std::size_t checkLevels(const asset::SceneFile& file, const scene::BuildOptions& build, const std::string& name) {
  std::size_t levels = 0;
  for (const asset::Chain& chain : file.chains)
    levels = std::max(levels, chain.levels.size());
  for (std::size_t k = 0; k < levels; ++k) {
    asset::SceneFile one = file;
    for (asset::Chain& chain : one.chains) {
      chain.levels = {chain.levels[std::min(k, chain.levels.size() - 1)]};
      chain.coverage.clear();
    }
    const scene::SceneData scene = scene::buildScene(one, build);
    render::FrameRenderer renderer(scene, kWidth, kHeight);
    const auto tour = test::tour(scene, 1, 11);
    for (const scene::Camera& camera :
         {scene::frameBox(scene.boundsWorld, static_cast<float>(kWidth) / kHeight), tour(0), tour(1)}) {
      std::vector<std::uint8_t> plain;
      for (const FaceCullingRow& row : faceCullingTable()) {
        render::FrameOptions options = optionsOf({}, row.id);
        options.lodRule = LodRule::kFinest;
        renderer.render(options, camera, camera);
        const ImageRgba8 image = renderer.readImage();
        if (row.id == FaceCulling::kOff) plain = image.pixels;
        bench::require(image.pixels == plain, fmt::format("{}: {} changes the picture of level {}", name, row.name, k));
      }
    }
  }
  return levels;
}

/// Geometric mean of the times over those without a test, frame by frame.
double timeRatio(const Measured& test, const Measured& plain) {
  double sum = 0.0;
  for (std::size_t i = 0; i < plain.ms.size(); ++i)
    sum += std::log(test.ms[i] / plain.ms[i]);
  return std::exp(sum / static_cast<double>(plain.ms.size()));
}

double percentOf(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

void measureScene(const Arguments& arguments, const std::string& name, nlohmann::ordered_json& figures) {
  const asset::SceneFile file = asset::readSceneFile(name);
  scene::BuildOptions build{.faces = true};
  if (arguments.cells) build.cells.kind = scene::CellOptions::Kind::kAutomatic;
  const scene::SceneData scene = scene::buildScene(file, build);
  if (scene.objects.empty()) throw Error(ErrorCode::kUsage, "the scene has no objects", name);
  const std::vector<Measured> results = measure(arguments, scene);
  const std::size_t levels = checkLevels(file, build, name);
  const std::size_t bytes = scene.faces.nodes.size() * sizeof(gpu::FaceNode);
  const auto groups = std::count_if(scene.faces.nodes.begin(), scene.faces.nodes.end(), [&](const gpu::FaceNode& node) {
    return node.next == static_cast<gpu::uint>(&node - scene.faces.nodes.data()) + 1;
  });
  fmt::print(
      "\n{}: {} objects, {} cells, {} groups{}, {:.0f} kB; pictures equal at all {} levels\n\n", name,
      scene.objects.size(), scene.cells.objects.size(), groups,
      groups > 0 ? fmt::format(" of {} triangles", scene.indices.size() / 3 / static_cast<std::size_t>(groups)) : "",
      static_cast<double>(bytes) / 1000.0, levels);
  fmt::print("| test | left whole, % | culled of all, % | culled of tested, % | commands a frame | time over off |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const FaceCullingRow& row : faceCullingTable()) {
    const Measured& result = results[static_cast<std::size_t>(row.id)];
    const render::FrameStatistics& sum = result.sum;
    const double ratio = timeRatio(result, results[0]);
    fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {} | {:.2f} |\n", row.name, percentOf(sum.facesWhole, sum.triangles),
               percentOf(sum.facesCulled, sum.triangles), percentOf(sum.facesCulled, sum.facesTested),
               sum.draws / arguments.frames, ratio);
    std::fflush(stdout);
    figures.push_back({{"scene", name},
                       {"test", row.name},
                       {"frames", arguments.frames},
                       {"wrong_frames", result.wrongFrames},
                       {"triangles", sum.triangles},
                       {"faces_tested", sum.facesTested},
                       {"faces_culled", sum.facesCulled},
                       {"faces_whole", sum.facesWhole},
                       {"commands", sum.draws},
                       {"groups", groups},
                       {"table_bytes", bytes},
                       {"levels_compared", levels},
                       {"time_over_off", ratio}});
    bench::require(result.wrongFrames == 0, fmt::format("{}: {} changes the picture", name, row.name));
  }
}

/// A point of the cube of directions. @param side  2 * axis + (negative)   @param u, v  -1..1
glm::dvec3 onCube(std::uint32_t side, double u, double v) {
  const std::uint32_t axis = side / 2;
  glm::dvec3 point;
  point[static_cast<int>(axis)] = side % 2 == 0 ? 1.0 : -1.0;
  point[static_cast<int>((axis + 1) % 3)] = u;
  point[static_cast<int>((axis + 2) % 3)] = v;
  return point;
}

/// Share of all directions of normals whose cells are back faces for every ray of a sector of the view.
/// @param low, high  tangents of the corners of the sector
double culledDirections(std::uint32_t cells, const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec3 rays[] = {{low.x, low.y, -1}, {high.x, low.y, -1}, {low.x, high.y, -1}, {high.x, high.y, -1}};
  const auto line = [&](std::uint32_t k) { return 2.0 * k / cells - 1.0; };
  double culled = 0.0;
  double all = 0.0;
  for (std::uint32_t i = 0; i < 6 * cells * cells; ++i) {
    const std::uint32_t side = i / (cells * cells);
    const std::uint32_t column = i % cells;
    const std::uint32_t row = i / cells % cells;
    bool back = true;
    for (const double u : {line(column), line(column + 1)})
      for (const double v : {line(row), line(row + 1)})
        for (const glm::dvec3& ray : rays)
          back = back && glm::dot(onCube(side, u, v), ray) > 0.0;
    const double u = 0.5 * (line(column) + line(column + 1));
    const double v = 0.5 * (line(row) + line(row + 1));
    const double angle = std::pow(1.0 + u * u + v * v, -1.5);  // solid angle of a cell, up to a factor
    all += angle;
    culled += back ? angle : 0.0;
  }
  return culled / all;
}

/// Mean over sectors x sectors parts of the picture.
double culledDirections(std::uint32_t cells, std::uint32_t sectors, const glm::dvec2& tangents) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < sectors * sectors; ++i) {
    const glm::dvec2 at(i % sectors, i / sectors);
    const glm::dvec2 low = tangents * (2.0 * at / static_cast<double>(sectors) - 1.0);
    sum += culledDirections(cells, low, low + 2.0 * tangents / static_cast<double>(sectors));
  }
  return sum / (sectors * sectors);
}

/// The lecture's calculation: all directions of normals alike, and no object.
void printDirections(nlohmann::ordered_json& figures) {
  const double tangent = std::tan(0.5 * 46.0 * std::numbers::pi / 180.0);
  fmt::print("\nBack faces by cells of normals alone, fovY 46, 16:9, all directions alike; the limit is 50 %\n\n");
  fmt::print("| cells a side | 1 x 1 sector, % | 4 x 4 sectors, % |\n|---|---|---|\n");
  for (const std::uint32_t cells : {6U, 16U}) {
    const double one = 100.0 * culledDirections(cells, 1, {tangent * 16.0 / 9.0, tangent});
    const double many = 100.0 * culledDirections(cells, 4, {tangent * 16.0 / 9.0, tangent});
    fmt::print("| {} | {:.1f} | {:.1f} |\n", cells, one, many);
    figures.push_back({{"cells", cells}, {"one_sector_percent", one}, {"sixteen_sectors_percent", many}});
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  bench::GlBench bench(
      "face_bench", "Measures the tests of back faces: triangles left out, commands, bytes and time",
      R"(Frustum culling and levels by pixel error along a path around, through and in the scene, 1280x720. Times are those of a
frame over the same frame without a test (geometric mean over the frames of medians). Every picture is compared with the
one without a test: the exit code is 1 if a pixel differs.
Examples:
  face_bench dragon.glb
      measures a file of jalousie-bake --backface clusters
  face_bench --finest --cells-off --json faces.json bunnies.glb city.glb
      draws all objects whole and at LOD 0, and writes the figures
)");
  bench.options().add_option("scenes", arguments.scenes, "glTF files")->type_name("SCENE");
  bench.options()
      .add_option("--frames", arguments.frames, "Length of the path; frames")
      ->check(CLI::Range(4, 100000).description(""))
      ->capture_default_str();
  bench.options()
      .add_option("--repeat", arguments.repeat, "Times that each frame is measured")
      ->check(CLI::Range(1, 1000).description(""))
      ->capture_default_str();
  bench.options().add_flag("--finest", arguments.finest, "Draw all objects at LOD 0");
  bench.options().add_flag("!--cells-off", arguments.cells, "Do not divide objects into cells");
  return bench.run(argc, argv, [&](nlohmann::ordered_json& figures) {
    figures = nlohmann::ordered_json::array();
    if (arguments.scenes.empty()) printDirections(figures);
    for (const std::string& scene : arguments.scenes)
      measureScene(arguments, scene, figures);
  });
}
