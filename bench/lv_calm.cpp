// Temporal stability: LOD switches along a slow path and under jitter, and the change that one switch makes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/median.h"
#include "core/random.h"
#include "gl_bench.h"
#include "lv_path.h"
#include "lv_setup.h"

namespace jalousie::bench {
namespace {

constexpr int kPathFrames = 119;
constexpr int kJitterFrames = 120;
constexpr int kFrozenFrames = 24;      // after the path
constexpr int kJitterWarmUp = 240;     // frames; a smoothed LV adapts slowly
constexpr float kJitter = 0.01F;       // share of the median distance
constexpr double kLeastPixels = 64.0;  // of an object whose change per pixel counts

/// Median distance of the visible surfaces, world units; 1 if there are none.
float medianDistance(render::FrameRenderer& renderer, const scene::Camera& camera) {
  std::vector<float> distances;
  for (const float depth : renderer.readDepth())
    if (depth > 0.0F) distances.push_back(camera.zNear / depth);
  return distances.empty() ? 1.0F : median(std::move(distances));
}

struct Change {
  double pixels = 0.0;  ///< largest change of one object, in pixels from black to white
  double share = 0.0;   ///< largest change of one object over its pixels
};

/// A picture and the object numbers of its pixels.
struct Picture {
  ImageRgba8 image;
  std::vector<std::uint32_t> ids;
};

Picture readPicture(render::FrameRenderer& renderer) {
  Picture picture{renderer.readImage(), {}};
  renderer.renderIds();
  picture.ids = renderer.readIds();
  return picture;
}

/// Largest change over all objects between two pictures of the same camera: what one LOD switch does.
Change largestChange(const Picture& before, const Picture& after) {
  std::map<std::uint32_t, std::pair<double, double>> sums;
  for (std::uint32_t y = 0; y < kLvHeight; ++y) {
    for (std::uint32_t x = 0; x < kLvWidth; ++x) {
      const std::size_t pixel = std::size_t{kLvHeight - 1 - y} * kLvWidth + x;
      const std::size_t at = before.image.offset(x, y);
      double difference = 0.0;
      for (std::size_t c = 0; c < 3; ++c)
        difference += std::abs(before.image.pixels[at + c] - after.image.pixels[at + c]) / (3.0 * 255.0);
      auto& [sum, count] = sums[after.ids[pixel] > 0 ? after.ids[pixel] : before.ids[pixel]];
      sum += difference;
      count += 1.0;
    }
  }
  Change change;
  for (const auto& [id, entry] : sums) {
    if (id == 0) continue;
    change.pixels = std::max(change.pixels, entry.first);
    if (entry.second >= kLeastPixels) change.share = std::max(change.share, entry.first / entry.second);
  }
  return change;
}

/// What was summed over the path.
struct PathTotals {
  SwitchTotals switches;
  double fading = 0.0;     ///< share of the drawn objects, mean per frame
  double triangles = 0.0;  ///< mean per frame
};

/// One configuration in one view. The three measurements share the renderer's history: call them in this order.
struct Run {
  render::FrameRenderer& renderer;
  render::FrameOptions drawn;
  Path path;

  render::FrameOptions undrawn() const {
    render::FrameOptions options = drawn;
    options.skipDraw = true;
    return options;
  }

  PathTotals alongPath() const {
    PathTotals totals;
    const auto never = [](int) { return false; };
    walk(renderer, drawn, path, never, [&](int) {
      const render::FrameStatistics statistics = renderer.readStatistics();
      requireCounts(statistics, "a frame of the path");
      totals.switches.add(renderer);
      totals.triangles += static_cast<double>(statistics.triangles) / kPathFrames;
      totals.fading += static_cast<double>(statistics.fading) /
                       static_cast<double>(std::max<std::uint64_t>(statistics.drawn, 1)) / kPathFrames;
    });
    return totals;
  }

  /// The camera stops at the end of the path: only LOD switches change the picture.
  Change afterPath() const {
    const scene::Camera end = path.at(kPathFrames + 1);
    renderer.render(drawn, end, end);
    Picture last = readPicture(renderer);
    Change change;
    for (int frame = 0; frame < kFrozenFrames; ++frame) {
      renderer.render(drawn, end, end);
      Picture now = readPicture(renderer);
      const Change one = largestChange(last, now);
      change = {std::max(change.pixels, one.pixels), std::max(change.share, one.share)};
      last = std::move(now);
    }
    return change;
  }

  SwitchTotals underJitter() const {
    SwitchTotals totals;
    const scene::Camera& start = path.start;
    Random random(5);
    renderer.resetHistory();
    renderer.render(drawn, start, start);
    const float reach = kJitter * medianDistance(renderer, start);
    for (int frame = 0; frame < kJitterWarmUp + kJitterFrames; ++frame) {
      const glm::vec3 offset(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      scene::Camera camera = start;
      camera.worldFromCamera = glm::translate(glm::mat4(1.0F), reach * offset) * start.worldFromCamera;
      renderer.render(undrawn(), camera, camera);
      if (frame >= kJitterWarmUp) totals.add(renderer);
    }
    return totals;
  }
};

void printHead(const LvView& view) {
  fmt::print(
      "{}, view {}\n| configuration | switches per visible object and frame, 0.25 degree path | under +-1 % jitter | "
      "objects in a fade | triangles on the path | largest change of one object, camera frozen: pixels, share "
      "|\n|---|---|---|---|---|---|\n",
      view.sceneName, view.text);
}

}  // namespace

void measureCalm(const LvView& view, bool calmOnly, nlohmann::ordered_json& figures) {
  printHead(view);
  struct Row {
    LvConfiguration configuration;
    bool calm;
  };
  for (const Row& row : {Row{kThesis, false},
                         {kUniform, false},
                         {kUniform, true},
                         {kRelaxed, false},
                         {kRelaxed, true},
                         {kDefault, false},
                         {kDefault, true}}) {
    if (calmOnly && !row.calm) continue;
    render::FrameRenderer renderer(view.scene, kLvWidth, kLvHeight);
    const Run run{renderer,
                  optionsOf(row.configuration, 1.0F, row.calm),
                  {view.camera(), view.scene.boundsWorld.center(), kPathFrames}};
    const PathTotals path = run.alongPath();
    const Change change = run.afterPath();
    const SwitchTotals jitter = run.underJitter();
    const std::string name = std::string(row.configuration.name) + (row.calm ? ", calm" : "");
    fmt::print("| {} | {:.3f} % | {:.4f} % | {:.2f} % | {:.0f} | {:.2f}, {:.4f} |\n", name,
               100.0 * path.switches.perObject(), 100.0 * jitter.perObject(), 100.0 * path.fading, path.triangles,
               change.pixels, change.share);
    std::fflush(stdout);
    figures.push_back({{"scene", view.sceneName},
                       {"view", view.text},
                       {"configuration", name},
                       {"switches_on_path", path.switches.perObject()},
                       {"switches_under_jitter", jitter.perObject()},
                       {"fading", path.fading},
                       {"triangles", path.triangles},
                       {"frozen_change_pixels", change.pixels},
                       {"frozen_change_share", change.share}});
  }
}

}  // namespace jalousie::bench
