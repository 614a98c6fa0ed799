// What one frame did: plain values.
#pragma once

#include <cstdint>
#include <vector>

#include "culling/query_figures.h"

namespace jalousie::render {

/// Figures of one frame, counted on the GPU; those of queries by the mode that asks them, else 0.
struct FrameStatistics : culling::QueryFigures {
  std::uint64_t frame = 0;  ///< which frame of its renderer, counted from 1
  std::uint64_t objects = 0;
  std::uint64_t culledFrustum = 0;
  std::uint64_t culledOcclusion = 0;  ///< occluded and not drawn
  std::uint64_t culledSmall = 0;      ///< below the contribution threshold
  std::uint64_t occluders = 0;
  std::uint64_t drawn = 0;
  std::uint64_t drawnEarly = 0;  ///< of drawn: in the first of two phases
  std::uint64_t drawnStale = 0;  ///< of drawnEarly: occluded in this frame
  std::uint64_t switches = 0;    ///< of drawn: at another level than in the last frame
  std::uint64_t fading = 0;      ///< of drawn: at two levels, cross-faded
  std::uint64_t dropped = 0;     ///< objects that are missing, or miss a level, because a draw list had no room
  std::uint64_t cells = 0;       ///< of all objects, in scenes with cells; dropped then counts cells
  std::uint64_t cellsDrawn = 0;  ///< of cells; an object counts as drawn if one of its cells is
  /// Commands in the lists that were drawn; with occlusion queries the draw calls of the slices instead.
  std::uint64_t draws = 0;
  std::uint64_t triangles = 0;  ///< of the drawn objects, both levels of those that fade
  // With FrameOptions::faceCulling; triangles counts these all.
  std::uint64_t facesTested = 0;      ///< single-sided opaque triangles in groups
  std::uint64_t facesCulled = 0;      ///< of these: back faces that were not drawn
  std::uint64_t facesWhole = 0;       ///< double-sided, masked and bent triangles, which are left whole
  std::uint64_t trianglesFinest = 0;  ///< all objects at their finest
  /// Drawn objects per level: LOD 0, 1, ... of the discrete chains, or tessellation level 1, 2, ... of the patch path.
  std::vector<std::uint64_t> lodHistogram;
};

}  // namespace jalousie::render
