// All constants of culling modes, level rules and visibility measures that lv_bench uses.
#include "lv_setup.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "compare/configuration.h"
#include "core/error.h"

namespace jalousie::bench {
namespace {

constexpr int kSettle = 6;  // frames

constexpr LvConfiguration kMeasureRows[] = {
    {"hiz + lv-error, pixels", CullMode::kHiz, LodRule::kLvError, LvMeasure::kPixels},
    {"hiz + lv-error, coverage", CullMode::kHiz, LodRule::kLvError, LvMeasure::kCoverage},
    {"hiz + lv-error, chord", CullMode::kHiz, LodRule::kLvError, LvMeasure::kChord},
    {"hiz + lv-error, spectral", CullMode::kHiz, LodRule::kLvError, LvMeasure::kSpectral},
    {"hiz + lv-error, thesis", CullMode::kHiz, LodRule::kLvError, LvMeasure::kThesis},
    {"hom + lv-error, coverage", CullMode::kHom, LodRule::kLvError, LvMeasure::kCoverage},
    {"hom + lv-error, chord", CullMode::kHom, LodRule::kLvError, LvMeasure::kChord},
    {"hom + lv-error, thesis", CullMode::kHom, LodRule::kLvError, LvMeasure::kThesis},
};

}  // namespace

const LvConfiguration kUniform = {"hiz + pixel-error", CullMode::kHiz, LodRule::kPixelError, LvMeasure::kNone};
const LvConfiguration kFrustum = {"frustum + pixel-error", CullMode::kFrustum, LodRule::kPixelError, LvMeasure::kNone};
const LvConfiguration kRelaxed = {"hiz + lv-error, pixels", CullMode::kHiz, LodRule::kLvError, LvMeasure::kPixels};
const LvConfiguration kDefault = {"hiz + price, pixels", CullMode::kHiz, LodRule::kPrice, LvMeasure::kPixels};
const LvConfiguration kThesis = {"hom + thesis", CullMode::kHom, LodRule::kLinear, LvMeasure::kThesis};
const std::span<const LvConfiguration> kOtherMeasures = kMeasureRows;

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
  return optionsOf({"", twoPhases ? CullMode::kHiz : CullMode::kFrustum, LodRule::kFinest, LvMeasure::kNone}, 1.0F);
}

scene::Camera LvView::camera() const {
  glm::vec3 eye;
  glm::vec3 look;
  if (std::sscanf(text.c_str(), "%f,%f,%f:%f,%f,%f", &eye.x, &eye.y, &eye.z, &look.x, &look.y, &look.z) == 6)
    return scene::lookAt(eye - glm::vec3(scene.originWorld), look - glm::vec3(scene.originWorld), scene.boundsWorld);
  char* end = nullptr;
  const float frame = std::strtof(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0')
    throw Error(ErrorCode::kUsage, "a view is a frame or EYE:LOOK as X,Y,Z:X,Y,Z", text);
  if (scene.cameras.empty()) throw Error(ErrorCode::kUsage, "the scene has no camera path; give EYE:LOOK", text);
  return scene::cameraAtFrame(scene.cameras.front(), frame);
}

nlohmann::ordered_json orNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

ImageRgba8 settledImage(render::FrameRenderer& renderer, const render::FrameOptions& options,
                        const scene::Camera& camera) {
  renderer.resetHistory();
  for (int i = 0; i < (dependsOnHistory(options) ? kSettle : 1); ++i)
    renderer.render(options, camera, camera);
  return renderer.readImage();
}

}  // namespace jalousie::bench
