// Butteraugli: a distance between pictures that models visual masking, computed by libjxl.
#pragma once

#include <cstdint>

#include "core/image.h"

namespace jalousie::compare {

/// Distance of a picture from a reference in units of the just noticeable difference: at about 1, most viewers begin to
/// see a difference when they look for it. An error counts less in a busy part of the reference (masking).
struct ButteraugliError {
  double mean = 0.0;     ///< libjxl's "3-norm" of the distances of all pixels; 0 for equal pictures
  double largest = 0.0;  ///< of one pixel
};

/// For a display of 80 cd/m2, with the values of libjxl's program butteraugli_main. Large pictures are processed in
/// tiles, with the values of the whole picture, so that memory follows the size of a tile. Alpha is ignored. Not
/// symmetric: the reference masks.
/// @pre equal sizes, sides at least kLeastSsimSide (checked)   Errors: kInternal where libjxl refuses the pictures
ButteraugliError butteraugli(const ImageRgba8& reference, const ImageRgba8& test);

/// Memory that butteraugli() takes beside the two pictures, bytes.
std::uint64_t butteraugliBytes(std::uint32_t width, std::uint32_t height);

}  // namespace jalousie::compare
