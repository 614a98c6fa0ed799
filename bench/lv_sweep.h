// Triangles and image error of one configuration over a range of tau, and what two such sweeps say at equal error.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "lv_setup.h"

namespace jalousie::bench {

inline constexpr float kTaus[] = {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F};  // pixels
inline constexpr std::size_t kOnePixel = 3;                                      // index of tau = 1
inline constexpr double kMostTriangles = 2e7;  // from here on, a frame takes minutes on a software renderer

/// One picture against the one with every object at its finest level.
struct Sample {
  double triangles = 0.0;
  double psnr = 0.0;  ///< dB
  double ssim = 0.0;
};

/// A renderer, a camera and the picture with every object at its finest level.
struct Stage {
  render::FrameRenderer& renderer;
  scene::Camera camera;
  ImageRgba8 reference;

  Sample sample(const render::FrameOptions& options);
  /// Samples over taus, finest last; the finest ones are left out where they cost too much.
  /// @param options  tau is replaced   @param name  of the configuration, for the message of a wrong result
  std::vector<Sample> sweep(render::FrameOptions options, std::span<const float> taus, const char* name);
  /// Median times of kCountInterval frames, one of which counts pixels, in ms. The configurations run in turn, each
  /// after two frames in which it settles. @param pass  the only pass that counts; empty: all
  std::vector<double> interleavedTimes(const std::vector<render::FrameOptions>& all, std::string_view pass = {});
};

/// Triangles at which a sweep reaches a value of Sample::psnr or Sample::ssim: the logarithm of the triangles is
/// interpolated linearly between samples. Below its range the cheapest sample counts; above it the result is NaN.
double trianglesAt(const std::vector<Sample>& samples, double Sample::*error, double value);

/// Mean ratio of triangles at equal error, over the errors that `levels` has at a tau of 2, 1, 0.5 and 0.25.
/// @param error  Sample::psnr or Sample::ssim   @param levels  a sweep over kTaus
double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels, double Sample::*error = &Sample::psnr);

}  // namespace jalousie::bench
