// LDR-FLIP: P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020. Section numbers in
// the comments refer to this paper; the constants are from its table 1 and section 4.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "compare/image_error.h"
#include "core/check.h"

namespace jalousie::compare {
namespace {

using Plane = std::vector<float>;
using Color = std::array<double, 3>;

// sRGB to CIE XYZ under D65. kWhite is the XYZ of white, the sum of the three primaries.
constexpr double kXyzFromRgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                      {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                      {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

constexpr Color xyzOf(const Color& rgb) {
  Color xyz{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k)
      xyz[row] += kXyzFromRgb[row][k] * rgb[k];
  return xyz;
}
constexpr Color kWhite = xyzOf({1.0, 1.0, 1.0});

/// The inverse of kXyzFromRgb by Cramer's rule.
constexpr std::array<Color, 3> inverseMatrix() {
  const auto& m = kXyzFromRgb;
  std::array<Color, 3> result{};
  double determinant = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    determinant += m[0][c] * (m[1][(c + 1) % 3] * m[2][(c + 2) % 3] - m[1][(c + 2) % 3] * m[2][(c + 1) % 3]);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      result[c][r] = (m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] -
                      m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3]) /
                     determinant;
    }
  }
  return result;
}
constexpr std::array<Color, 3> kRgbFromXyz = inverseMatrix();

std::array<double, 256> linearTable() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double s = static_cast<double>(i) / 255.0;
    table[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return table;
}

/// [2 radius + 1] weights of a symmetric or antisymmetric kernel.
using Kernel = std::vector<float>;

/// Convolves every row with a kernel; beyond the border the nearest pixel is repeated.
Plane convolveRows(const Plane& source, std::uint32_t width, std::uint32_t height, const Kernel& kernel) {
  const std::size_t radius = kernel.size() / 2;
  Plane result(source.size(), 0.0F);
  std::vector<float> padded(width + 2 * radius);
  for (std::uint32_t y = 0; y < height; ++y) {
    const float* in = &source[std::size_t{y} * width];
    float* out = &result[std::size_t{y} * width];
    std::fill_n(padded.begin(), radius, in[0]);
    std::copy_n(in, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, in[width - 1]);
    for (std::size_t t = 0; t < kernel.size(); ++t)
      for (std::uint32_t x = 0; x < width; ++x)
        out[x] += kernel[t] * padded[x + t];
  }
  return result;
}

/// Convolves every column likewise.
Plane convolveColumns(const Plane& source, std::uint32_t width, std::uint32_t height, const Kernel& kernel) {
  const auto radius = static_cast<std::int64_t>(kernel.size() / 2);
  Plane result(source.size(), 0.0F);
  for (std::int64_t y = 0; y < height; ++y) {
    float* out = &result[static_cast<std::size_t>(y) * width];
    for (std::size_t t = 0; t < kernel.size(); ++t) {
      const std::int64_t row = std::clamp<std::int64_t>(y + static_cast<std::int64_t>(t) - radius, 0, height - 1);
      const float* in = &source[static_cast<std::size_t>(row) * width];
      for (std::uint32_t x = 0; x < width; ++x)
        out[x] += kernel[t] * in[x];
    }
  }
  return result;
}

/// One term a sqrt(pi / b) exp(-pi^2 d^2 / b) of a contrast sensitivity filter over the distance d in degrees.
struct GaussianTerm {
  double a, b;
};
// Table 1: luminance, red-green, blue-yellow.
constexpr GaussianTerm kLuminance[] = {{1.0, 0.0047}};
constexpr GaussianTerm kRedGreen[] = {{1.0, 0.0053}};
constexpr GaussianTerm kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestB = 0.04;

/// Half the width of the contrast sensitivity filters, pixels.
int sensitivityRadius(double pixelsPerDegree) {
  constexpr double kPi = std::numbers::pi;
  return static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * pixelsPerDegree));
}

/// 4.1.1: filters a channel by contrast sensitivity. Each Gaussian is separable; the weights of all terms add up to 1.
Plane spatiallyFiltered(const Plane& channel, std::uint32_t width, std::uint32_t height,
                        std::span<const GaussianTerm> terms, double pixelsPerDegree) {
  constexpr double kPi = std::numbers::pi;
  const int radius = sensitivityRadius(pixelsPerDegree);
  std::vector<std::vector<double>> profiles;
  double total = 0.0;
  for (const GaussianTerm& term : terms) {
    std::vector<double>& profile = profiles.emplace_back();
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
      const double degrees = i / pixelsPerDegree;
      profile.push_back(std::exp(-kPi * kPi * degrees * degrees / term.b));
      sum += profile.back();
    }
    total += term.a * std::sqrt(kPi / term.b) * sum * sum;
  }
  Plane result(channel.size(), 0.0F);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double weight =
        std::sqrt(terms[k].a * std::sqrt(kPi / terms[k].b) / total);  // applied to rows and to columns
    Kernel kernel;
    for (const double value : profiles[k])
      kernel.push_back(static_cast<float>(weight * value));
    const Plane part = convolveColumns(convolveRows(channel, width, height, kernel), width, height, kernel);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += part[i];
  }
  return result;
}

/// 4.2: derivative of a Gaussian as wide as the features that the eye detects. Positive weights add up to 1, negative
/// ones to -1. @param order  1: edges, 2: points
Kernel featureKernel(int order, double deviation) {
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  std::vector<double> weights;
  double positive = 0.0;
  double negative = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    const double gaussian = std::exp(-i * i / (2.0 * deviation * deviation));
    weights.push_back(order == 1 ? -i * gaussian : (i * i / (deviation * deviation) - 1.0) * gaussian);
    (weights.back() > 0.0 ? positive : negative) += std::abs(weights.back());
  }
  Kernel kernel;
  for (const double weight : weights)
    kernel.push_back(static_cast<float>(weight > 0.0 ? weight / positive : weight / negative));
  return kernel;
}

Kernel gaussianKernel(double deviation) {
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(std::exp(-i * i / (2.0 * deviation * deviation)));
    sum += weights.back();
  }
  Kernel kernel;
  for (const double weight : weights)
    kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

/// Width of the detected features, degrees.
constexpr double kFeatureDegrees = 0.082;

/// Length of the gradient at each pixel. @param order  of the derivative, 1 or 2
Plane featureStrength(const Plane& luminance, std::uint32_t width, std::uint32_t height, int order,
                      double pixelsPerDegree) {
  const double deviation = 0.5 * kFeatureDegrees * pixelsPerDegree;
  const Kernel derivative = featureKernel(order, deviation);
  const Kernel gaussian = gaussianKernel(deviation);
  Plane alongX = convolveColumns(convolveRows(luminance, width, height, derivative), width, height, gaussian);
  const Plane alongY = convolveColumns(convolveRows(luminance, width, height, gaussian), width, height, derivative);
  for (std::size_t i = 0; i < alongX.size(); ++i)
    alongX[i] = std::sqrt(alongX[i] * alongX[i] + alongY[i] * alongY[i]);
  return alongX;
}

double labCurve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

/// 4.1.2: CIELAB with the Hunt effect: chroma decreases with lightness. @param xyz  relative to white
Color huntLab(const Color& xyz) {
  const double fx = labCurve(xyz[0]);
  const double fy = labCurve(xyz[1]);
  const double fz = labCurve(xyz[2]);
  const double lightness = 116.0 * fy - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (fx - fy), 0.01 * lightness * 200.0 * (fy - fz)};
}

constexpr double kColorExponent = 0.7;    // qc
constexpr double kFeatureExponent = 0.5;  // qf
constexpr double kKnee = 0.4;             // pc: share of the largest distance at which the slope of the error changes
constexpr double kKneeValue = 0.95;       // pt: error at this share

double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/// qc-th power of the largest colour distance, the one between green and blue.
double largestColorDistance() {
  const auto lab = [](const Color& rgb) {
    Color xyz = xyzOf(rgb);
    for (std::size_t c = 0; c < 3; ++c)
      xyz[c] /= kWhite[c];
    return huntLab(xyz);
  };
  return std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), kColorExponent);
}

}  // namespace

FlipImage::FlipImage(const ImageRgba8& image, double pixelsPerDegree) : width_(image.width), height_(image.height) {
  JAL_CHECK(pixelsPerDegree >= kLeastPixelsPerDegree);
  JAL_CHECK(pixelsPerDegree <= kMostPixelsPerDegree);
  JAL_CHECK(width_ > 0U);
  JAL_CHECK(height_ > 0U);
  const std::size_t count = std::size_t{width_} * height_;
  // YCxCz, the opponent space that the filters are defined in.
  static const std::array<double, 256> kLinear = linearTable();
  Plane opponent[3];
  for (Plane& plane : opponent)
    plane.resize(count);
  Plane luminance(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = &image.pixels[4 * i];
    Color xyz = xyzOf({kLinear[p[0]], kLinear[p[1]], kLinear[p[2]]});
    for (std::size_t c = 0; c < 3; ++c)
      xyz[c] /= kWhite[c];
    opponent[0][i] = static_cast<float>(116.0 * xyz[1] - 16.0);
    opponent[1][i] = static_cast<float>(500.0 * (xyz[0] - xyz[1]));
    opponent[2][i] = static_cast<float>(200.0 * (xyz[1] - xyz[2]));
    luminance[i] = static_cast<float>(xyz[1]);
  }
  edge_ = featureStrength(luminance, width_, height_, 1, pixelsPerDegree);
  point_ = featureStrength(luminance, width_, height_, 2, pixelsPerDegree);
  const std::span<const GaussianTerm> filters[] = {kLuminance, kRedGreen, kBlueYellow};
  for (std::size_t c = 0; c < 3; ++c)
    opponent[c] = spatiallyFiltered(opponent[c], width_, height_, filters[c], pixelsPerDegree);
  for (Plane& plane : lab_)
    plane.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double y = (static_cast<double>(opponent[0][i]) + 16.0) / 116.0;
    const Color xyz = {(y + static_cast<double>(opponent[1][i]) / 500.0) * kWhite[0], y * kWhite[1],
                       (y - static_cast<double>(opponent[2][i]) / 200.0) * kWhite[2]};
    Color rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k)
        rgb[c] += kRgbFromXyz[c][k] * xyz[k];
      rgb[c] = std::clamp(rgb[c], 0.0, 1.0);  // filtered colours can lie outside the cube
    }
    Color relative = xyzOf(rgb);
    for (std::size_t c = 0; c < 3; ++c)
      relative[c] /= kWhite[c];
    const Color lab = huntLab(relative);
    for (std::size_t c = 0; c < 3; ++c)
      lab_[c][i] = static_cast<float>(lab[c]);
  }
}

std::vector<float> flipMap(const FlipImage& reference, const FlipImage& test) {
  JAL_CHECK(reference.width_ == test.width_);
  JAL_CHECK(reference.height_ == test.height_);
  static const double kLargest = largestColorDistance();
  std::vector<float> map(reference.edge_.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto lab = [i](const FlipImage& image) {
      return Color{image.lab_[0][i], image.lab_[1][i], image.lab_[2][i]};
    };
    // 4.1.3: colour error; small distances get most of the range.
    const double distance = std::pow(hyab(lab(reference), lab(test)), kColorExponent);
    const double knee = kKnee * kLargest;
    const double color = distance < knee ? distance * kKneeValue / knee
                                         : kKneeValue + (distance - knee) / (kLargest - knee) * (1.0 - kKneeValue);
    // 4.2 and 4.3: the feature error amplifies the colour error.
    const double difference =
        std::max(std::abs(reference.edge_[i] - test.edge_[i]), std::abs(reference.point_[i] - test.point_[i]));
    const double feature = std::clamp(std::pow(difference / std::numbers::sqrt2, kFeatureExponent), 0.0, 1.0);
    map[i] = static_cast<float>(std::clamp(std::pow(color, 1.0 - feature), 0.0, 1.0));
  }
  return map;
}

std::uint32_t flipMarginRows(double pixelsPerDegree) {
  const auto feature = static_cast<int>(std::ceil(1.5 * kFeatureDegrees * pixelsPerDegree));
  return static_cast<std::uint32_t>(std::max(sensitivityRadius(pixelsPerDegree), feature));
}

void flipStrips(const ImageRgba8& reference, const ImageRgba8& test, double pixelsPerDegree,
                const std::function<void(std::span<const float> values)>& take) {
  JAL_CHECK(reference.width == test.width);
  JAL_CHECK(reference.height == test.height);
  const std::uint32_t margin = flipMarginRows(pixelsPerDegree);
  const auto rows = [](const ImageRgba8& image, std::uint32_t first, std::uint32_t end) {
    const auto at = [&](std::uint32_t y) {
      return image.pixels.begin() + static_cast<std::ptrdiff_t>(image.offset(0, y));
    };
    return ImageRgba8{image.width, end - first, {at(first), at(end)}};
  };
  for (std::uint32_t y = 0; y < reference.height; y += kFlipStripRows) {
    const std::uint32_t end = std::min(y + kFlipStripRows, reference.height);
    const std::uint32_t firstRow = y - std::min(y, margin);
    const std::uint32_t endRow = std::min(end + margin, reference.height);
    const std::vector<float> map = flipMap(FlipImage(rows(reference, firstRow, endRow), pixelsPerDegree),
                                           FlipImage(rows(test, firstRow, endRow), pixelsPerDegree));
    take(std::span(map).subspan(std::size_t{y - firstRow} * reference.width, std::size_t{end - y} * reference.width));
  }
}

ImageRgba8 errorPicture(const std::vector<float>& map, std::uint32_t width, std::uint32_t height) {
  JAL_CHECK(map.size() == std::size_t{width} * height);
  // Nine points of matplotlib's "magma", interpolated linearly.
  constexpr double kScale[9][3] = {{0, 0, 4},      {28, 16, 68},   {79, 18, 123},   {129, 37, 129}, {181, 54, 122},
                                   {229, 80, 100}, {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};
  ImageRgba8 picture{width, height, std::vector<std::uint8_t>(4 * map.size(), 255)};
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double at = 8.0 * std::clamp(static_cast<double>(map[i]), 0.0, 1.0);
    const auto lower = std::min<std::size_t>(static_cast<std::size_t>(at), 7);
    const double share = at - static_cast<double>(lower);
    for (std::size_t c = 0; c < 3; ++c)
      picture.pixels[4 * i + c] =
          static_cast<std::uint8_t>(std::lround(std::lerp(kScale[lower][c], kScale[lower + 1][c], share)));
  }
  return picture;
}

}  // namespace jalousie::compare
