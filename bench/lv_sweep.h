// Triangles and image error of one configuration over a range of tau.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "compare/image_error.h"
#include "core/image.h"
#include "equal_error.h"
#include "lv_setup.h"

namespace jalousie::bench {

inline constexpr double kMostTriangles = 2e7;  // from here on, a frame takes minutes on a software renderer

/// What samples are compared with.
struct Reference {
  ImageRgba8 image;                          ///< every object at its finest level, no occlusion culling
  std::optional<compare::FlipImage> flip{};  ///< of the image; absent: FLIP is not measured
  std::vector<std::uint8_t> covered{};       ///< 1 where an object is seen; [height * width], row 0 at the top

  /// Everything of a sample but its triangles.
  Sample errorsOf(const ImageRgba8& test) const;
};

/// A reference whose FLIP is measured over the pixels that show an object.
Reference coveredReference(render::FrameRenderer& renderer, const scene::Camera& camera);

/// A renderer, a camera and what its pictures are compared with.
struct Stage {
  render::FrameRenderer& renderer;
  scene::Camera camera;
  Reference reference;
  std::vector<ImageRgba8>* pictures = nullptr;  ///< gets the picture of every sample; may be null

  Sample sample(const render::FrameOptions& options);
  /// Samples over taus, finest last; the finest ones are left out where they cost too much.
  /// @param options  tau is replaced   @param name  of the configuration, for the message of a wrong result
  std::vector<Sample> sweep(render::FrameOptions options, std::span<const float> taus, const char* name);
};

/// Requires that the pictures at the end of a sweep are no worse than those at its start.
void requireImproves(const std::vector<Sample>& samples, const char* name);

}  // namespace jalousie::bench
