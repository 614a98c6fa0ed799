// Figures that an experiment measures, as plain types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/image_error.h"
#include "compare/object_figures.h"
#include "render/frame_statistics.h"

namespace jalousie::compare {

/// Figures of one configuration at one frame.
struct Sample {
  std::uint32_t frame = 0;
  std::size_t configuration = 0;  ///< index
  render::FrameStatistics statistics;
  double frameMs = 0.0;                                ///< sum over the passes
  std::vector<std::pair<std::string, double>> passes;  ///< name and ms, in frame order
  std::optional<ImageError> error;                     ///< absent without a reference
  std::optional<std::uint64_t> visible;      ///< objects with at least one visible pixel; absent without pictures
  std::optional<std::uint64_t> switched;     ///< of these, objects drawn at another level than in the frame before
  std::optional<std::uint64_t> lost;         ///< FrameObjects::lost; absent without pictures
  std::optional<std::uint64_t> wrongPixels;  ///< FrameObjects::wrongPixels
  std::optional<double> temporal;            ///< as KeptSample::temporal; absent where frames are left out
};

/// Figures of one configuration at a kept frame, beside those of its pictures.
struct KeptSample {
  std::uint32_t frame = 0;
  std::size_t configuration = 0;  ///< index
  /// FLIP between two frames of the same camera, of which the second one has advanced the renderer's state by one
  /// frame. The two differ only by level switches.
  double frozenMean = 0.0;
  double frozenLargest = 0.0;  ///< of one pixel
  /// Mean |FLIP(I_k, I_k-1) - FLIP(R_k, R_k-1)| over the pixels, with I the picture and R the reference: change that
  /// the reference does not have (popping), and change of the reference that the picture does not have.
  double temporal = 0.0;
  /// Column with half of the error on each side, share of the width: where a reader should look first. Without an error
  /// that of the pixels that show an object; 0.5 without these.
  double subject = 0.5;
};

/// One configuration at one kept frame with one tau of the sweep.
struct SweepSample {
  std::size_t configuration = 0;  ///< index
  float tau = 1.0F;               ///< pixels
  std::uint32_t frame = 0;
  std::uint64_t triangles = 0;
  double frameMs = 0.0;
  ImageError error;
};

/// All figures measured so far, in the order of the plan.
struct Results {
  std::vector<Sample> samples;
  std::vector<KeptSample> kept;
  std::vector<SweepSample> sweep;
  std::vector<ObjectsSample> objects;
  bool complete = false;  ///< all steps of the experiment have run
};

/// Appends the samples of `more`; `complete` is unchanged.
void append(Results& results, const Results& more);

}  // namespace jalousie::compare
