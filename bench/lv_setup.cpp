// All constants of culling modes, level rules and visibility measures that lv_bench uses.
#include "lv_setup.h"

#include <cstdio>
#include <cstdlib>

#include "compare/configuration.h"
#include "core/error.h"

namespace jalousie::bench {
namespace {

constexpr int kSettle = 6;  // frames

constexpr LvConfiguration kMeasures[] = {
    {"hiz + lv-error, coverage", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvCoverage},
    {"hiz + lv-error, chord", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvChord},
    {"hiz + lv-error, spectral", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvSpectral},
    {"hiz + lv-error, thesis", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvThesis},
    {"hom + lv-error, coverage", gpu::kCullHom, gpu::kLodLvError, gpu::kLvCoverage},
    {"hom + lv-error, chord", gpu::kCullHom, gpu::kLodLvError, gpu::kLvChord},
    {"hom + lv-error, thesis", gpu::kCullHom, gpu::kLodLvError, gpu::kLvThesis},
};

}  // namespace

const LvConfiguration kUniform = {"hiz + pixel-error", gpu::kCullHiz, gpu::kLodPixelError, gpu::kLvNone};
const LvConfiguration kFrustum = {"frustum + pixel-error", gpu::kCullFrustum, gpu::kLodPixelError, gpu::kLvNone};
const LvConfiguration kDefault = {"hiz + lv-error, pixels", gpu::kCullHiz, gpu::kLodLvError, gpu::kLvPixels};
const LvConfiguration kThesis = {"hom + thesis", gpu::kCullHom, gpu::kLodLinear, gpu::kLvThesis};
const std::span<const LvConfiguration> kOtherMeasures = kMeasures;

render::FrameOptions optionsOf(const LvConfiguration& configuration, float tau, bool calm) {
  render::FrameOptions options;
  options.cullMode = configuration.mode;
  options.lodRule = configuration.rule;
  options.lvMeasure = configuration.measure;
  options.tau = tau;
  options.calm = calm;
  return options;
}

render::FrameOptions finestOptions(bool twoPhases) {
  return optionsOf({"", twoPhases ? gpu::kCullHiz : gpu::kCullFrustum, gpu::kLodFinest, gpu::kLvNone}, 1.0F);
}

scene::Camera LvView::camera() const {
  glm::vec3 eye;
  glm::vec3 look;
  if (std::sscanf(text.c_str(), "%f,%f,%f:%f,%f,%f", &eye.x, &eye.y, &eye.z, &look.x, &look.y, &look.z) == 6)
    return scene::lookAt(eye, look, scene.boundsWorld);
  if (scene.cameras.empty()) throw Error(ErrorCode::kUsage, "the scene has no camera path; give EYE:LOOK", text);
  return scene::cameraAtFrame(scene.cameras.front(), std::strtof(text.c_str(), nullptr));
}

ImageRgba8 settledImage(render::FrameRenderer& renderer, const render::FrameOptions& options,
                        const scene::Camera& camera) {
  renderer.resetHistory();
  for (int i = 0; i < (compare::dependsOnHistory(options) ? kSettle : 1); ++i)
    renderer.render(options, camera, camera);
  return renderer.readImage();
}

}  // namespace jalousie::bench
