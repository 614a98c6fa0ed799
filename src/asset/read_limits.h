// Limits on what a document may ask for, and the observer of the files that it refers to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace jalousie::asset {

/// Limits on one encoded picture, checked against its header before anything is allocated.
struct ImageLimits {
  std::uint32_t maxSide = 16384;          ///< pixels; the largest texture side that OpenGL 4.5 guarantees
  std::uint64_t maxPixels = 1ULL << 26U;  ///< 8192 x 8192 for a square one: 256 MiB as RGBA8
};

/// Limits on what a document may ask for; exceeded ones throw kLimit before anything is allocated.
struct Limits {
  std::uint64_t maxFileBytes = 2ULL << 30U;         ///< any single file read, buffers included
  std::uint32_t maxJsonDepth = 64;                  ///< nesting of arrays and objects
  std::uint64_t maxJsonElements = 20'000'000;       ///< commas in the JSON, a bound on its values
  std::uint64_t maxAccessorElements = 1ULL << 28U;  ///< elements of one accessor
  std::uint64_t maxEmptyElements = 1ULL << 22U;     ///< elements of all accessors without data, which cost no byte
  std::uint64_t maxInstances = 1ULL << 24U;         ///< objects after flattening the node hierarchy
  std::uint64_t maxFreePixels = 1ULL << 28U;        ///< of all pictures passed on, beyond 1024 for each of their bytes
  ImageLimits images;                               ///< each picture
};

/// Called for every file that is read beside the document itself. @param name  relative to the document's folder
/// @param bytes  the file's content; absent if the file does not exist. The function may be empty.
using ReadObserver = std::function<void(const std::string& name, std::optional<std::span<const std::byte>> bytes)>;

}  // namespace jalousie::asset
