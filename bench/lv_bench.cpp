// Whether hiddenness pays, and how calmly: the default against the strongest baselines.
//
//   build/release/bin/lv_bench worth SCENE VIEW...   triangles, image error and frame time at the same camera
//   build/release/bin/lv_bench measures SCENE VIEW...   the same for every measure of hiddenness, without times
//   build/release/bin/lv_bench calm SCENE VIEW...    level switches on a 0.25 degree path, under jitter, and what one
//   shows; calm-default: without the thesis and what is not calm
//
// VIEW is a frame of the scene's camera path, or EYE:LOOK as x,y,z:x,y,z.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "compare/switches.h"
#include "compare/image_error.h"
#include "core/error.h"
#include "core/random.h"
#include "platform/headless_context.h"
#include "render/frame_renderer.h"

namespace {

using namespace jalousie;

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;
constexpr int kSettle = 6;

struct Configuration {
  const char* name;
  gpu::uint mode, rule, measure;
};
constexpr Configuration kUniform = {"hiz + pixel-error", gpu::kCullHiz, gpu::kLodPixelError, gpu::kLvNone};
constexpr Configuration kDefault = {"hiz + lv-error, pixels", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvPixels};
constexpr Configuration kFrustum = {"frustum + pixel-error", gpu::kCullFrustum, gpu::kLodPixelError, gpu::kLvNone};
constexpr Configuration kThesis = {"hom + thesis", gpu::kCullHom, gpu::kLodLinear, gpu::kLvThesis};
constexpr Configuration kOthers[] = {
    {"hiz + lv-error, coverage", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvCoverage},
    {"hiz + lv-error, chord", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvChord},
    {"hiz + lv-error, spectral", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvSpectral},
    {"hiz + lv-error, thesis", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvThesis},
    {"hom + lv-error, coverage", gpu::kCullHom, gpu::kLodLvError, gpu::kLvCoverage},
    {"hom + lv-error, chord", gpu::kCullHom, gpu::kLodLvError, gpu::kLvChord},
    {"hom + lv-error, thesis", gpu::kCullHom, gpu::kLodLvError, gpu::kLvThesis},
};

render::FrameOptions optionsOf(const Configuration& configuration, float tau, bool calm = false) {
  render::FrameOptions options;
  options.cullMode = configuration.mode;
  options.lodRule = configuration.rule;
  options.lvMeasure = configuration.measure;
  options.tau = tau;
  options.calm = calm;
  return options;
}

scene::Camera parseView(const std::string& text, const scene::SceneData& scene) {
  glm::vec3 eye;
  glm::vec3 look;
  if (std::sscanf(text.c_str(), "%f,%f,%f:%f,%f,%f", &eye.x, &eye.y, &eye.z, &look.x, &look.y, &look.z) == 6)
    return scene::lookAt(eye, look, scene.boundsWorld);
  if (scene.cameras.empty()) throw Error(ErrorCode::kUsage, "the scene has no camera; give EYE:LOOK", text);
  return scene::cameraAtFrame(scene.cameras.front(), std::strtof(text.c_str(), nullptr));
}

struct Sample {
  double triangles = 0.0;
  double psnr = 0.0;
  double ssim = 0.0;
};

ImageRgba8 settledImage(render::FrameRenderer& renderer, const render::FrameOptions& options,
                        const scene::Camera& camera) {
  renderer.resetHistory();
  const bool hasHistory = options.cullMode == gpu::kCullHiz || options.lvMeasure == gpu::kLvPixels;
  for (int i = 0; i < (hasHistory ? kSettle : 1); ++i)
    renderer.render(options, camera, camera);
  return renderer.readImage();
}

Sample sample(render::FrameRenderer& renderer, const render::FrameOptions& options, const scene::Camera& camera,
              const ImageRgba8& reference) {
  const ImageRgba8 image = settledImage(renderer, options, camera);
  return {static_cast<double>(renderer.readStatistics().triangles), compare::psnr(reference, image),
          compare::ssim(reference, image)};
}

constexpr double kMostTriangles = 2e7;  ///< on a software renderer a frame takes seconds from here on

/// Samples of a configuration over tau, finest last.
std::vector<Sample> sweep(render::FrameRenderer& renderer, const Configuration& configuration,
                          const scene::Camera& camera, const ImageRgba8& reference) {
  std::vector<Sample> samples;
  for (const float tau : {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F}) {
    samples.push_back(sample(renderer, optionsOf(configuration, tau), camera, reference));
    if (samples.size() > 4 && samples.back().triangles > kMostTriangles) break;  // minutes a frame
  }
  return samples;
}

/// Triangles at which a sweep reaches an error: logarithm of the triangles, linear between samples. Below its range its
/// cheapest sample counts, above it nothing does.
double trianglesAt(const std::vector<Sample>& samples, double psnr) {
  if (psnr <= samples.front().psnr) return samples.front().triangles;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    if (psnr > b.psnr || std::isinf(b.psnr)) continue;
    const double t = (psnr - a.psnr) / std::max(b.psnr - a.psnr, 1e-9);
    return std::exp(std::log(a.triangles) + t * (std::log(b.triangles) - std::log(a.triangles)));
  }
  return std::nan("");
}

/// Mean ratio of triangles at equal error, over the errors that a uniform tau of 0.25, 0.5, 1 and 2 gives.
double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 2; i <= 5 && i < levels.size(); ++i) {
    const double ratio = std::log(trianglesAt(samples, levels[i].psnr) / trianglesAt(base, levels[i].psnr));
    if (std::isnan(ratio)) continue;
    sum += ratio;
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : std::nan("");
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double frameMs(render::FrameRenderer& renderer) {
  double sum = 0.0;
  for (const gl::PassTime& pass : renderer.timer().passes())
    sum += pass.ms;
  return sum;
}

/// Median frame times, configurations in turn, each settled for two frames first.
std::vector<double> interleavedTimes(render::FrameRenderer& renderer, const std::vector<render::FrameOptions>& all,
                                     const scene::Camera& camera) {
  std::vector<std::vector<double>> times(all.size());
  renderer.timer().setTiming(gl::Timing::kWall);
  for (int round = 0; round < 7; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      renderer.render(all[i], camera, camera);
      renderer.render(all[i], camera, camera);
      double sum = 0.0;  // one of them is counted
      for (std::uint32_t k = 0; k < render::kCountInterval; ++k) {
        renderer.render(all[i], camera, camera);
        sum += frameMs(renderer);
      }
      times[i].push_back(sum);
    }
  }
  renderer.timer().setTiming(gl::Timing::kOff);
  std::vector<double> medians;
  for (std::vector<double>& samples : times)
    medians.push_back(median(std::move(samples)));
  return medians;
}

void worth(const scene::SceneData& scene, const std::string& name, const std::string& view, bool measures) {
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const scene::Camera camera = parseView(view, scene);
  const ImageRgba8 reference =
      settledImage(renderer, optionsOf({"", gpu::kCullFrustum, gpu::kLodFinest, gpu::kLvNone}, 1.0F), camera);
  const std::vector<Sample> uniform = sweep(renderer, kUniform, camera, reference);
  const std::vector<Sample> frustum = sweep(renderer, kFrustum, camera, reference);
  std::printf(
      "%s, view %s\n| configuration | triangles | PSNR | SSIM | frame / hiz + pixel-error | triangles at equal "
      "PSNR / hiz + pixel-error | / frustum + pixel-error |\n|---|---|---|---|---|---|---|\n",
      name.c_str(), view.c_str());
  // Times at about equal error: the tau of the default whose PSNR is next to the baseline's at one pixel.
  const std::vector<Sample> own = sweep(renderer, kDefault, camera, reference);
  const float taus[] = {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F};
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (std::abs(own[i].psnr - uniform[3].psnr) < std::abs(own[nearest].psnr - uniform[3].psnr)) nearest = i;
  const Sample thesis = sample(renderer, optionsOf(kThesis, 1.0F), camera, reference);
  std::vector<double> times(5, std::nan(""));
  if (!measures) {
    std::vector<render::FrameOptions> timed = {optionsOf(kUniform, 1.0F), optionsOf(kFrustum, 1.0F),
                                               optionsOf(kDefault, 1.0F), optionsOf(kDefault, taus[nearest])};
    if (thesis.triangles <= kMostTriangles) timed.push_back(optionsOf(kThesis, 1.0F));
    const std::vector<double> measured = interleavedTimes(renderer, timed, camera);
    std::copy(measured.begin(), measured.end(), times.begin());
  }
  const auto row = [&](const std::string& what, const Sample& s, double time, double toUniform, double toFrustum) {
    std::printf("| %s | %.0f | %.2f | %.4f | %.2f | %.2f | %.2f |\n", what.c_str(), s.triangles, s.psnr, s.ssim, time,
                toUniform, toFrustum);
    std::fflush(stdout);
  };
  row(std::string(kFrustum.name) + ", tau 1", frustum[3], times[1] / times[0],
      ratioAtEqualError(frustum, uniform, uniform), 1.0);
  row(std::string(kUniform.name) + ", tau 1", uniform[3], 1.0, 1.0, ratioAtEqualError(uniform, frustum, uniform));
  row(kThesis.name, thesis, times[4] / times[0], thesis.triangles / trianglesAt(uniform, thesis.psnr),
      thesis.triangles / trianglesAt(frustum, thesis.psnr));
  const double toUniform = ratioAtEqualError(own, uniform, uniform);
  const double toFrustum = ratioAtEqualError(own, frustum, uniform);
  row(std::string(kDefault.name) + ", tau 1", own[3], times[2] / times[0], toUniform, toFrustum);
  char label[96];
  std::snprintf(label, sizeof(label), "the same, tau %g", static_cast<double>(taus[nearest]));
  row(label, own[nearest], times[3] / times[0], toUniform, toFrustum);
  if (!measures) return;
  for (const Configuration& other : kOthers) {
    const std::vector<Sample> samples = sweep(renderer, other, camera, reference);
    row(std::string(other.name) + ", tau 1", samples[3], std::nan(""), ratioAtEqualError(samples, uniform, uniform),
        ratioAtEqualError(samples, frustum, uniform));
  }
}

/// Median distance of what a view shows, world units.
float medianDistance(render::FrameRenderer& renderer, const scene::Camera& camera) {
  std::vector<float> distances;
  for (const float depth : renderer.readDepth())
    if (depth > 0.0F) distances.push_back(camera.zNear / depth);
  if (distances.empty()) return 1.0F;
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2),
                   distances.end());
  return distances[distances.size() / 2];
}

scene::Camera turned(const scene::Camera& camera, const glm::vec3& center, float degrees) {
  scene::Camera result = camera;
  const glm::mat4 about = glm::rotate(glm::translate(glm::mat4(1.0F), center), glm::radians(degrees), {0, 1, 0});
  result.worldFromCamera = glm::translate(about, -center) * camera.worldFromCamera;
  return result;
}

struct Change {
  double pixels = 0.0;  ///< largest change of one object, in pixels from black to white
  double share = 0.0;   ///< the same over the object's pixels
};

/// What one object's change of level does to the picture: the largest over all objects.
Change largestChange(const ImageRgba8& before, const ImageRgba8& after, const std::vector<std::uint32_t>& idsBefore,
                     const std::vector<std::uint32_t>& ids) {
  std::map<std::uint32_t, std::pair<double, double>> sums;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const std::size_t pixel = std::size_t{kHeight - 1 - y} * kWidth + x;
      const std::size_t at = before.offset(x, y);
      double difference = 0.0;
      for (std::size_t c = 0; c < 3; ++c)
        difference += std::abs(before.pixels[at + c] - after.pixels[at + c]) / (3.0 * 255.0);
      auto& [sum, count] = sums[ids[pixel] > 0 ? ids[pixel] : idsBefore[pixel]];
      sum += difference;
      count += 1.0;
    }
  }
  Change change;
  for (const auto& [id, entry] : sums) {
    if (id == 0) continue;
    change.pixels = std::max(change.pixels, entry.first);
    if (entry.second >= 64.0) change.share = std::max(change.share, entry.first / entry.second);
  }
  return change;
}

void calm(const scene::SceneData& scene, const std::string& name, const std::string& view, bool calmOnly) {
  const scene::Camera start = parseView(view, scene);
  const glm::vec3 center = scene.boundsWorld.center();
  std::printf(
      "%s, view %s\n| configuration | switches per visible object and frame, 0.25 degree path | under +-1 %% "
      "jitter | objects in a fade | triangles on the path | largest change of one object, camera frozen: pixels, share "
      "|\n|---|---|---|---|---|---|\n",
      name.c_str(), view.c_str());
  struct Row {
    Configuration configuration;
    bool calm;
  };
  for (const Row& row :
       {Row{kThesis, false}, {kUniform, false}, {kUniform, true}, {kDefault, false}, {kDefault, true}}) {
    if (calmOnly && !row.calm) continue;
    render::FrameRenderer renderer(scene, kWidth, kHeight);
    const render::FrameOptions drawn = optionsOf(row.configuration, 1.0F, row.calm);
    render::FrameOptions options = drawn;
    options.skipDraw = true;  // draws what the figures need
    constexpr int kWarmUp = 40;
    constexpr int kFrames = 120;
    double switches = 0.0;
    double visible = 0.0;
    double fading = 0.0;
    double triangles = 0.0;
    for (int frame = 0; frame < kWarmUp + kFrames; ++frame) {
      // Still at first, so that the start is no part of the path.
      const scene::Camera camera = turned(start, center, 0.25F * static_cast<float>(std::max(0, frame - kWarmUp)));
      renderer.render(options, camera, camera);
      if (frame <= kWarmUp) continue;
      const render::FrameStatistics statistics = renderer.readStatistics();
      const compare::Switches now = compare::countSwitches(renderer);
      switches += static_cast<double>(now.switched);
      visible += static_cast<double>(now.visible);
      triangles += static_cast<double>(statistics.triangles) / (kFrames - 1);
      fading +=
          static_cast<double>(statistics.fading) / static_cast<double>(std::max<std::uint64_t>(statistics.drawn, 1));
    }
    const double onPath = switches / visible;
    const double fades = fading / (kFrames - 1);

    // Camera frozen at the end of the path: what still changes are levels alone.
    Change change;
    const scene::Camera end = turned(start, center, 0.25F * kFrames);
    renderer.render(drawn, end, end);  // the camera stops
    for (int frame = 0; frame < 24; ++frame) {
      const ImageRgba8 last = renderer.readImage();
      renderer.renderIds();
      const std::vector<std::uint32_t> lastIds = renderer.readIds();
      renderer.render(drawn, end, end);
      const ImageRgba8 image = renderer.readImage();
      renderer.renderIds();
      const Change now = largestChange(last, image, lastIds, renderer.readIds());
      change = {std::max(change.pixels, now.pixels), std::max(change.share, now.share)};
    }

    Random random(5);
    renderer.resetHistory();
    renderer.render(drawn, start, start);
    const float reach = 0.01F * medianDistance(renderer, start);
    switches = visible = 0.0;
    constexpr int kJitterWarmUp = 240;  // LV leaves slowly
    for (int frame = 0; frame < kJitterWarmUp + kFrames; ++frame) {
      scene::Camera camera = start;
      camera.worldFromCamera =
          glm::translate(glm::mat4(1.0F),
                         reach * glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))) *
          start.worldFromCamera;
      renderer.render(options, camera, camera);
      if (frame < kJitterWarmUp) continue;
      const compare::Switches now = compare::countSwitches(renderer);
      switches += static_cast<double>(now.switched);
      visible += static_cast<double>(now.visible);
    }
    std::printf("| %s%s | %.3f %% | %.4f %% | %.2f %% | %.0f | %.2f, %.4f |\n", row.configuration.name,
                row.calm ? ", calm" : "", 100.0 * onPath, 100.0 * switches / visible, 100.0 * fades, triangles,
                change.pixels, change.share);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc >= 4 ? argv[1] : "";
  if (what != "worth" && what != "measures" && what != "calm" && what != "calm-default") {
    std::fprintf(stderr,
                 "usage: lv_bench worth|measures|calm|calm-default SCENE VIEW...   (VIEW: a frame of the camera path, "
                 "or EYE:LOOK)\n");
    return 2;
  }
  try {
    const platform::HeadlessContext context(false);
    const scene::SceneData scene = scene::buildScene(asset::readSceneFile(argv[2]));
    for (int i = 3; i < argc; ++i)
      what.starts_with("calm") ? calm(scene, argv[2], argv[i], what == "calm-default")
                               : worth(scene, argv[2], argv[i], what == "measures");
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "lv_bench: %s\n", error.what());
    return error.exitCode();
  }
}
