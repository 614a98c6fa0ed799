// How far a picture is from a reference: PSNR, SSIM and LDR-FLIP, and FLIP's map.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace jalousie::compare {

/// Peak signal-to-noise ratio over R, G and B, dB; infinite for equal pictures. @pre equal sizes (checked)
double psnr(const ImageRgba8& reference, const ImageRgba8& test);

/// Smallest side ssim() can judge, pixels.
inline constexpr std::uint32_t kLeastSsimSide = 8;

/// Mean structural similarity (Wang et al. 2004) of R, G and B in windows of 8x8 pixels, 4 apart, variances with n - 1,
/// as ffmpeg's filter has it; 1 for equal pictures. @pre equal sizes, sides at least kLeastSsimSide (checked)
double ssim(const ImageRgba8& reference, const ImageRgba8& test);

/// Pixels per degree of a 0.7 m wide monitor of 3840 pixels seen from 0.7 m: 67.02, the default of the paper.
inline constexpr double kDefaultPixelsPerDegree = 3840.0 * 3.14159265358979323846 / 180.0;
/// Below, the contrast sensitivity filters are narrower than a pixel; above, wider than any picture needs.
inline constexpr double kLeastPixelsPerDegree = 1.0;
inline constexpr double kMostPixelsPerDegree = 1000.0;

/// One picture as FLIP's observer sees it: what is invisible at this distance filtered away, and how much of an edge
/// and of a point each pixel is (Andersson et al. 2020, sections 4.1 and 4.2).
class FlipImage {
 public:
  /// @param image  sRGB; alpha is ignored   @param pixelsPerDegree  of visual angle (range checked)
  explicit FlipImage(const ImageRgba8& image, double pixelsPerDegree = kDefaultPixelsPerDegree);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  friend std::vector<float> flipMap(const FlipImage& reference, const FlipImage& test);

  std::uint32_t width_;
  std::uint32_t height_;
  std::vector<float> lab_[3];  ///< CIELAB, Hunt-adjusted; [height * width] each
  std::vector<float> edge_;
  std::vector<float> point_;
};

/// LDR-FLIP per pixel, in [0, 1]; row 0 at the top. @pre equal sizes (checked)
std::vector<float> flipMap(const FlipImage& reference, const FlipImage& test);

/// Mean of a map; 0 for an empty one.
double mean(const std::vector<float>& map);

/// A map in [0, 1] as a picture: black, violet, orange, pale yellow (the scale FLIP's authors use).
ImageRgba8 errorPicture(const std::vector<float>& map, std::uint32_t width, std::uint32_t height);

/// The three at once.
struct ImageError {
  double psnr = 0.0;  ///< dB
  double ssim = 1.0;
  double flip = 0.0;  ///< mean
};

}  // namespace jalousie::compare
