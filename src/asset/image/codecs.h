// What asset/image_io.h is made of: one reader per format, all with the same signature.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/image_io.h"

namespace jalousie::asset::detail {

/// Gives a reader the memory that it writes rows of RGBA8 to.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Called once, before the first row, with a size within the limits.
  virtual void begin(const ImageSize& size) = 0;
  /// Memory for row y: 4 * width bytes. Rows come from top to bottom, and again for each pass of an interlaced PNG,
  /// which changes some pixels of a row and keeps the others.
  virtual std::uint8_t* row(std::uint32_t y) = 0;
};

// Readers. They check the limits, and that a file of this size can hold so many pixels, before they allocate memory for
// any. @param sink  null: read the header only. Errors (without a file): kMalformed with the reason of the library,
// also for lost data of which the library only warns; kUnsupported (a variant of the format); kLimit.
ImageSize readPng(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink);
ImageSize readJpeg(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink);
/// Decodes into the memory of row 0, which must be followed by that of all other rows.
ImageSize readWebp(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink);

/// Errors: kLimit.
void requireSize(const ImageSize& size, const ImageLimits& limits);
/// @param leastBytes  that any picture of this size and type takes. Errors: kMalformed.
void requireBytes(std::uint64_t bytes, std::uint64_t leastBytes, const ImageSize& size);

}  // namespace jalousie::asset::detail
