// What the method knows about one object: read back from the GPU and computed again by the CPU references.
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
  float errorObject = 0.0F;  ///< object-space length; infinite if the file states none
  float errorPixels = 0.0F;  ///< screen-space error
};

/// The block of the occlusion map or depth pyramid in front of the object, and its measures (thesis Fig. 3.3, 3.4).
struct InspectedBlock {
  std::uint32_t lom = 0;  ///< level at which the AABR is about one texel
  visibility::AnalysedBlock block;
  std::vector<double> spectrum;  ///< DCT of opacity - 1/2, F(u, v) at [v * width + u]
  float openShare = 1.0F;
  float fineness = 0.0F;                    ///< phi of the spectral measure
  float chordPixels = 0.0F;                 ///< mean open chord; infinite if all texels are equally open
  std::array<float, kLvMeasureCount> lv{};  ///< by LvMeasure; kPixels has the value of kCoverage
};

struct Inspection {
  std::uint32_t object = 0;    ///< index into SceneData::objects
  std::uint32_t instance = 0;  ///< index of the instance in the file
  std::string name;            ///< scene::shownName()
  std::string mesh;            ///< name of LOD 0; empty where it has none
  std::string chain;           ///< number of the chain
  Aabb boundsWorld;
  render::ObjectReadout readout;
  bool hasRect = false;                 ///< the bounding box has a finite AABR
  float importance = 1.0F;              ///< value of the importance mask at the object
  std::optional<InspectedBlock> block;  ///< absent without an AABR, or without map and pyramid
  std::optional<float> countedLv;       ///< LV from the number of its visible pixels; absent if not counted
  float masking = 1.0F;                 ///< factor by which errors count less behind small holes
  float tau = 0.0F;                     ///< budget of the screen-space error, pixels; masking is in it
  float relaxed = 1.0F;                 ///< factor of tau that follows from LV
  std::vector<InspectedLevel> levels;
  std::uint32_t chosen = 0;    ///< level at which it is drawn, or would be
  std::uint32_t cuts = 0;      ///< parts of each edge of the patches over that level; 0: no patches
  std::uint32_t finest = 0;    ///< coarsest level within tau
  std::uint32_t coarsest = 0;  ///< coarsest level within tau * relaxed
  std::string verdict;         ///< result of culling, as text
  std::string why;             ///< reason for the level, as text
};

/// Inspects an object in the last frame of a renderer. Draws the occluders into the targets of the renderer, which then
/// no longer hold the picture. Waits for the GPU.
/// @param object  index into scene.objects (checked)   @param options  of the last frame
Inspection inspectObject(std::uint32_t object, const scene::SceneData& scene, render::FrameRenderer& renderer,
                         const render::FrameOptions& options);

}  // namespace jalousie::app
