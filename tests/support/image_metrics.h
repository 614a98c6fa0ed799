// How far one picture is from another.
#pragma once

#include "core/image.h"

namespace jalousie::test {

/// Peak signal-to-noise ratio over R, G and B, dB; infinite for equal pictures. @pre equal sizes (checked)
double psnr(const ImageRgba8& a, const ImageRgba8& b);

/// Mean structural similarity (Wang et al. 2004) of the luma (BT.601) in windows of 8x8 pixels, 4 apart; 1 for equal
/// pictures. @pre equal sizes, at least 8x8 (checked)
double ssim(const ImageRgba8& a, const ImageRgba8& b);

}  // namespace jalousie::test
