// Configurations and views that lv_bench measures, and its measurements.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "core/image.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::bench {

inline constexpr std::uint32_t kLvWidth = 1280;
inline constexpr std::uint32_t kLvHeight = 720;

/// A culling mode, a level rule and a visibility measure.
struct LvConfiguration {
  const char* name;
  CullMode mode;
  LodRule rule;
  LvMeasure measure;
};

/// The baselines: levels by pixel error, with two-phase culling and with frustum culling.
extern const LvConfiguration kUniform;
extern const LvConfiguration kFrustum;
/// Levels by pixel error, relaxed by visibility.
extern const LvConfiguration kRelaxed;
/// The default: one price of a triangle for all objects.
extern const LvConfiguration kDefault;
/// The method of the thesis as published.
extern const LvConfiguration kThesis;
/// The rule of kRelaxed with every visibility measure.
extern const std::span<const LvConfiguration> kOtherMeasures;

/// @param tau  pixels   @param calm  temporally stable levels
render::FrameOptions optionsOf(const LvConfiguration& configuration, float tau, bool calm = false);
/// Every object at its finest level. @param twoPhases  false: frustum culling
render::FrameOptions finestOptions(bool twoPhases);

/// A scene and one of its views.
struct LvView {
  const scene::SceneData& scene;
  std::string sceneName;
  std::string text;  ///< a frame of the scene's first camera path, or EYE:LOOK as X,Y,Z:X,Y,Z

  /// Errors: kUsage if the scene has no camera path for a frame.
  scene::Camera camera() const;
};

/// The picture after enough frames for the configuration's history to settle.
ImageRgba8 settledImage(render::FrameRenderer& renderer, const render::FrameOptions& options,
                        const scene::Camera& camera);

/// A number for JSON: null for NaN and infinity.
nlohmann::ordered_json orNull(double value);

/// Triangles, image error and frame time at one camera, against both baselines. Prints a table and adds its rows.
/// @param allMeasures  every visibility measure instead of times
void measureWorth(const LvView& view, bool allMeasures, nlohmann::ordered_json& figures);

/// Triangles of the rule `price` at equal error over those of kUniform, for several caps and limits of the error and
/// for mean and largest errors, at one camera. Adds one row per variant.
void measureFit(const LvView& view, nlohmann::ordered_json& figures);
/// Prints the rows of measureFit: one per variant, with the geometric means over all views.
void printFit(const nlohmann::ordered_json& figures);

/// Triangles of the rule `price` and of the best choice of one level per object, at equal error over those of kUniform,
/// at one camera. Prints a row and adds it.
void measureBest(const LvView& view, nlohmann::ordered_json& figures);
/// Prints the head of the table that measureBest prints rows of.
void printBestHead();

/// LOD switches on a path of 0.25 degrees per frame and under jitter, and the change that one switch makes. Prints a
/// table and adds its rows. @param calmOnly  only temporally stable configurations
void measureCalm(const LvView& view, bool calmOnly, nlohmann::ordered_json& figures);

/// Tolerable error behind small holes over that behind one window, at the same visible share, by image metrics, for
/// occluders of three greys. Prints a table and adds its rows.
/// Errors: kUsage for a scene of several objects, or too few levels in the view
void measureMasking(const LvView& view, nlohmann::ordered_json& figures);
/// Prints the range of the rows of measureMasking over all views and occluders, and the exponent p of the best fit
/// (64 / hole)^p.
void printMasking(const nlohmann::ordered_json& figures);

/// Triangles and times of frames with --masking over those without, in alternating frames. Prints a table and adds its
/// rows.
void measureMaskingCost(const LvView& view, nlohmann::ordered_json& figures);

}  // namespace jalousie::bench
