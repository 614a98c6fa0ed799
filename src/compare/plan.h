// What an experiment measures: frames, picture size, reference, sweep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compare/image_error.h"

namespace jalousie::compare {

/// What pictures are compared with: every object at LOD 0.
enum class Reference {
  kNone,  ///< no pictures: only the culling passes run
  kLod0,  ///< two-phase culling, which never culls a visible pixel
  kFull,  ///< no culling at all; slow, and independent of every culling pass
};

/// The frames that are measured.
struct FrameRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;  ///< inclusive
  std::uint32_t step = 1;  ///< > 0

  /// Ascending. @pre step > 0 (checked)
  std::vector<std::uint32_t> frames() const;
};

struct Plan {
  FrameRange range;
  std::uint32_t width = 1280;  ///< pixels
  std::uint32_t height = 720;
  Reference reference = Reference::kLod0;
  /// Frames that are rendered without being measured before each measured frame of a range with step > 1, before each
  /// kept frame and before each point of the sweep. They build the history that the measured frame depends on.
  std::uint32_t lead = 8;
  std::uint32_t keep = 6;  ///< number of frames whose pictures are kept, evenly spread over the range
  /// Objects that are listed per configuration, in the frame in which its error is largest; 0: none.
  std::uint32_t objects = 100;
  std::vector<float> taus;   ///< of the sweep, ascending, pixels; empty: no sweep
  std::size_t baseline = 0;  ///< index of the configuration that ratios refer to
  double pixelsPerDegree = kDefaultPixelsPerDegree;
  bool butteraugli = false;  ///< measure ImageError::butteraugli too
  bool gpuTiming = false;    ///< GPU timestamps; false: wall time between two glFinish, for software renderers
  std::string renderer;      ///< GL_RENDERER; part of the fingerprints: pictures and times depend on the driver
  std::string build;         ///< digest of the program; part of the fingerprints likewise

  /// Frames whose pictures are kept, ascending; none without a reference.
  std::vector<std::uint32_t> keptFrames() const;
};

}  // namespace jalousie::compare
