// Everything the method knows about one object, read back after a click and worked out again by the plain CPU twins.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/frame_renderer.h"
#include "scene/scene_data.h"
#include "visibility/level_of_visibility.h"
#include "visibility/overlap_reference.h"

namespace jalousie::app {

struct InspectedLevel {
  std::uint32_t triangles = 0;
  float errorObject = 0.0F;  ///< object-space length; infinite where the file does not say
  float errorPixels = 0.0F;  ///< projected, pixels
};

/// The block of what hides in front of the object, and what is measured on it (thesis Fig. 3.3, 3.4).
struct InspectedBlock {
  std::uint32_t lom = 0;  ///< level at which the AABR is about one texel
  visibility::AnalysedBlock block;
  std::vector<double> spectrum;  ///< DCT of opacity - 1/2, F(u, v) at [v * width + u]
  float openShare = 1.0F;
  float fineness = 0.0F;                  ///< phi of the spectral measure
  float chordPixels = 0.0F;               ///< mean open chord; infinite where nothing differs
  std::array<float, gpu::kLvCount> lv{};  ///< by measure; kLvPixels has that of the covered share
};

struct Inspection {
  std::uint32_t object = 0;    ///< index into SceneData::objects
  std::uint32_t instance = 0;  ///< in the file's order
  std::string chain;           ///< name, or number
  Aabb boundsWorld;
  render::ObjectReadout readout;
  bool hasRect = false;                 ///< the box has a finite AABR on the screen
  float importance = 1.0F;              ///< of its place, from the mask
  std::optional<InspectedBlock> block;  ///< with a map or pyramid and an AABR
  std::optional<float> countedLv;       ///< from the pixels that showed it
  float tau = 0.0F;                     ///< error it may show, pixels
  float relaxed = 1.0F;                 ///< what hiddenness multiplies it by
  std::vector<InspectedLevel> levels;
  std::uint32_t chosen = 0;    ///< level drawn, or that would be
  std::uint32_t cuts = 0;      ///< patches over that level: each edge in so many; 0: no patches
  std::uint32_t finest = 0;    ///< coarsest level within tau
  std::uint32_t coarsest = 0;  ///< coarsest level within tau * relaxed
  std::string verdict;         ///< in words
  std::string why;             ///< why this level, in words
};

/// Reads the last frame of a renderer; draws what hid into its targets again, so the picture is gone afterwards.
/// @param options  of that frame   @pre object is one of the scene's (checked)
Inspection inspectObject(std::uint32_t object, const scene::SceneData& scene, render::FrameRenderer& renderer,
                         const render::FrameOptions& options);

}  // namespace jalousie::app
