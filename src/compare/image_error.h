// Errors of a picture against a reference: PSNR, SSIM and LDR-FLIP with its error map.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"

namespace jalousie::compare {

/// Peak signal-to-noise ratio over R, G and B, dB; infinite for equal pictures. @pre equal sizes (checked)
double psnr(const ImageRgba8& reference, const ImageRgba8& test);

/// Smallest width and height that ssim() accepts, pixels.
inline constexpr std::uint32_t kLeastSsimSide = 8;

/// Mean structural similarity (Wang et al. 2004) over R, G and B and over windows of 8x8 pixels, 4 pixels apart.
/// Variances are divided by n - 1, as in ffmpeg's filter. 1 for equal pictures.
/// @pre equal sizes, sides at least kLeastSsimSide (checked)
double ssim(const ImageRgba8& reference, const ImageRgba8& test);

/// Default of the FLIP paper: 67.02 pixels per degree, a monitor 0.7 m and 3840 pixels wide seen from 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 3840.0 * 3.14159265358979323846 / 180.0;
/// Below this, the contrast sensitivity filters are narrower than a pixel; above kMostPixelsPerDegree, their kernels
/// are wider than pictures are.
inline constexpr double kLeastPixelsPerDegree = 1.0;
inline constexpr double kMostPixelsPerDegree = 1000.0;

/// One picture, prepared for FLIP: colours after the contrast sensitivity filters (Andersson et al. 2020, section 4.1),
/// and the strength of edges and points at each pixel (section 4.2).
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
  std::vector<float> lab_[3];  ///< CIELAB with Hunt adjustment; [height * width] each
  std::vector<float> edge_;
  std::vector<float> point_;
};

/// LDR-FLIP per pixel, in [0, 1]; row 0 at the top. @pre equal sizes (checked)
std::vector<float> flipMap(const FlipImage& reference, const FlipImage& test);

/// Rows of a strip of flipStrips, without its margins.
inline constexpr std::uint32_t kFlipStripRows = 128;

/// Rows above and below a pixel that its FLIP value depends on.
std::uint32_t flipMarginRows(double pixelsPerDegree);

/// flipMap in strips of rows, from the top, with the same values bit for bit. Memory follows the size of a strip with
/// its margins, not of the pictures. @param take  called with the values of each strip   @pre equal sizes (checked)
void flipStrips(const ImageRgba8& reference, const ImageRgba8& test, double pixelsPerDegree,
                const std::function<void(std::span<const float> values)>& take);

/// Mean of a map; 0 for an empty one.
double mean(const std::vector<float>& map);

/// Mean over the pixels that are covered; absent if none is.
/// @param covered  0 or 1 for each pixel of the map; empty: none is
std::optional<double> meanOver(const std::vector<float>& map, const std::vector<std::uint8_t>& covered);

/// A map in [0, 1] in the colours of matplotlib's magma: black, violet, orange, pale yellow.
ImageRgba8 errorPicture(const std::vector<float>& map, std::uint32_t width, std::uint32_t height);

/// All errors of one picture.
struct ImageError {
  double psnr = 0.0;  ///< dB
  double ssim = 1.0;
  double flip = 0.0;                       ///< mean
  std::optional<double> flipCovered = {};  ///< mean over the pixels that show an object; absent if none does
  std::optional<double> butteraugli = {};  ///< ButteraugliError::mean; absent where it was not asked for
};

}  // namespace jalousie::compare
